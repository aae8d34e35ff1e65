//! Models with degenerate faces, normals off their planes, and numbers that are none.

use glam::Vec3;
use model::obj::{self, Model};

/// The model with these lines, or what is wrong with it.
fn model(lines: &str, response: &str) -> Result<Model, String> {
    let text = format!("mtllib materials\nusemtl gray\n{lines}");
    let materials = format!("newmtl gray\nKd {response}\n");
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
fn not_a_number_infinite_or_1e38_is_refused_where_a_face_uses_it() {
    let all = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
    let face = "f 1//1 2//1 3//1\n";
    let spellings = [
        "nan",
        "NaN",
        "inf",
        "-inf",
        "infinity",
        "1e38",
        "-1e38",
        "1e999",
        "1.#INF",
        "-1.#IND00",
        "1.#QNAN0",
        "1.#SNAN",
        "-nan(ind)",
        "1,5",
    ];
    for wrong in spellings {
        for (line, number, keyword) in [(3, "v 1 0 0", "v 1 0"), (6, "vn 0 0 1", "vn 0 0")] {
            let (wrong_line, at) = (format!("{keyword} {wrong}"), line + usize::from(line == 3));
            let lines = all.replace(number, &wrong_line);
            let error = model(&format!("{lines}{face}"), "0.5 0.5 0.5").unwrap_err();
            let place = format!("model:{at}: ");
            assert!(error.starts_with(&place) && error.contains(&format!("'{wrong}'")), "{error}");
            // What no face uses may be anything.
            let unused = format!("{all}{wrong_line}\n{face}");
            assert_eq!(model(&unused, "1 1 1"), model(&format!("{all}{face}"), "1 1 1"));
        }
        let error = model(&format!("{all}{face}"), &format!("0.5 {wrong} 0.5")).unwrap_err();
        assert!(error.starts_with("materials:2: ") && error.contains(wrong), "{error}");
    }
}
