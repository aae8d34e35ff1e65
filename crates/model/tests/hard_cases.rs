//! Models with degenerate faces, normals off their planes, and numbers that are none.

use glam::Vec3;
use model::obj::{self, Model};

/// The model with these lines, or what is wrong with it.
fn model(lines: &str, response: &str) -> Result<Model, String> {
    let text = format!("mtllib materials\nusemtl grey\n{lines}");
    let materials = format!("newmtl grey\nKd {response}\n");
    obj::parse(&text, |_| Ok(materials.clone())).map_err(|error| error.to_string())
}

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\n";

#[test]
fn degenerate_triangles_are_skipped() {
    let faces = "f 1 2 4\nf 1 2 3\nf 1 1 4\nf 2 3 4\nf 4 4 4\n";
    let facets = |model: Model| model.triangles.iter().map(|t| t.facet).collect::<Vec<_>>();
    // Those that remain keep their numbers.
    assert_eq!(model(&format!("{CORNERS}{faces}"), "0.5 0.5 0.5").map(facets), Ok(vec![0, 3]));
    // Of a quad with three corners in a line, one half is left.
    assert_eq!(model(&format!("{CORNERS}f 1 2 3 4\n"), "0.5 0.5 0.5").map(facets), Ok(vec![0]));
}

#[test]
fn normal_of_the_file_off_its_plane_only_chooses_the_side() {
    let normal = |vn: &str| {
        let text = format!("{CORNERS}vn {vn}\nf 1//1 2//1 4//1\n");
        model(&text, "0.5 0.5 0.5").map(|model| model.triangles[0].normal)
    };
    // The model has y up, so its z is the scene's -y.
    assert_eq!(normal("1 0 1"), Ok(Vec3::NEG_Y));
    assert_eq!(normal("1 0 -1"), Ok(Vec3::Y));
    // As in the handout's file, whose normals have five digits.
    for side in [1.0, -1.0] {
        let as_written = Vec3::new(0.0002, -side, 0.0).normalize();
        let of_file = normal(&format!("0.0002 0 {side}")).unwrap();
        assert!(of_file.x != 0.0 && of_file.distance(as_written) < 1e-6, "{of_file}");
    }
}

#[test]
fn degenerate_triangles_alone_are_refused() {
    let error = model(&format!("{CORNERS}f 1 2 3\nf 1 1 4\n"), "0.5 0.5 0.5").unwrap_err();
    assert!(error.contains(":8:") && error.contains("only degenerate ones (2)"), "{error}");
}

#[test]
fn not_a_number_infinite_or_1e38_is_refused() {
    for wrong in ["nan", "NaN", "inf", "-inf", "infinity", "1e38", "-1e38", "1e999"] {
        for (line, lines) in [
            (3, format!("v {wrong} 0 0")),
            (4, format!("\nv 0 0 {wrong}")),
            (3, format!("vn 0 {wrong} 0")),
        ] {
            let error = model(&lines, "0.5 0.5 0.5").unwrap_err();
            let place = format!("model:{line}: ");
            assert!(error.starts_with(&place) && error.contains(&format!("'{wrong}'")), "{error}");
        }
        let error = model(CORNERS, &format!("0.5 {wrong} 0.5")).unwrap_err();
        assert!(error.starts_with("materials:2: ") && error.contains(wrong), "{error}");
    }
}
