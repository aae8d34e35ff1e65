//! Model files as programs and people write them.

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use model::obj::{self, Model};

const BASE: &str = include_str!("field/base.obj");
const MATERIALS: &str = include_str!("field/base.mtl");

fn field(name: &str) -> Result<Model, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/field").join(name);
    obj::load(&path).map_err(|error| error.to_string())
}

/// The model in `text`, whose library holds `materials`, or what is wrong with it.
fn parse_with(text: &str, materials: &str) -> Result<Model, String> {
    obj::parse(text, |_| Ok(materials.to_owned())).map_err(|error| error.to_string())
}

fn parse(text: &str) -> Result<Model, String> {
    parse_with(text, MATERIALS)
}

/// Floor, wall and library as in [`BASE`], with `face` in place of the floor's.
fn with_floor(face: &str) -> String {
    BASE.replace("f 1 2 3 4", face)
}

/// What photons meet: triangles, and the responses of their surfaces.
fn surfaces(model: &Model) -> Vec<([DVec3; 3], Vec3, Vec3)> {
    let response = |mesh: usize| model.mesh_objects[mesh].material.base_diffuse_reflection();
    let triangles = model.triangles.iter();
    triangles.map(|t| (t.vertices, t.normal, response(t.parent_mesh_object))).collect()
}

fn assert_as_base(found: Result<Model, String>, what: &str) {
    let expected = parse(BASE).unwrap();
    let found = found.unwrap_or_else(|error| panic!("{what}: {error}"));
    assert_eq!(surfaces(&found), surfaces(&expected), "{what}");
    assert_eq!(found.notes, Vec::<String>::new(), "{what}");
}

#[test]
fn files_from_the_field_are_all_the_same_model() {
    for name in [
        "base.obj",
        "hash.obj",
        "hash_keyshot.obj",
        "hash_mtllib.obj",
        "cont_nospace_vt.obj",
        "cont_space.obj",
        "nan_normal_unused.obj",
        "zero_normal_unused.obj",
        "kd_missing_unused.obj",
        "kd_gray1.obj",
        "mtl_two_files.obj",
    ] {
        assert_as_base(field(name), name);
    }
}

#[test]
fn numbers_of_msvc_that_are_none_are_refused_with_file_and_line() {
    for (name, line, found) in
        [("ind_vertex_last.obj", 7, "-1.#IND00"), ("qnan_vertex_last.obj", 2, "1.#QNAN0")]
    {
        let error = field(name).unwrap_err();
        assert!(error.contains(&format!("{name}:{line}: ")), "{error}");
        assert!(error.contains(&format!("'{found}'")), "{error}");
    }
}

/// How many of the model's triangles cover the point (x, y) of the world, seen from above.
fn covers(model: &Model, x: f64, y: f64) -> usize {
    let side = |a: DVec3, b: DVec3| {
        (b - a).truncate().perp_dot(DVec3::new(x, y, 0.0).truncate() - a.truncate())
    };
    let floor = model.triangles.iter().filter(|triangle| triangle.parent_mesh_object == 0);
    floor
        .filter(|triangle| {
            let [a, b, c] = triangle.vertices;
            let sides = [side(a, b), side(b, c), side(c, a)];
            sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0)
        })
        .count()
}

/// Points that lie on no edge of the tests' polygons.
fn points() -> impl Iterator<Item = (f64, f64)> {
    let along = (0..50).map(|step| 0.0857 * f64::from(step) - 2.1013);
    along.clone().flat_map(move |x| along.clone().map(move |y| (x, y + 0.0313)))
}

#[test]
fn concave_faces_cover_what_their_triangles_cover() {
    for (name, triangles) in
        [("keyhole.obj", "keyhole_tri.obj"), ("concave_L_bad_start.obj", "concave_L_tri.obj")]
    {
        let (found, expected) = (field(name).unwrap(), field(triangles).unwrap());
        for (x, y) in points() {
            assert_eq!(covers(&found, x, y), covers(&expected, x, y), "{name} at {x}, {y}");
        }
        assert!(found.triangles.iter().take(4).all(|triangle| triangle.normal == Vec3::Z));
        let facets = found.triangles.iter().filter(|triangle| triangle.parent_mesh_object == 0);
        assert!(facets.into_iter().all(|triangle| triangle.facet == 0), "one face is one facet");
    }
}

#[test]
fn concave_faces_are_cut_rightly_from_every_corner_and_in_both_directions() {
    // A comb, whose corners are in x and z of the model.
    let comb = [(0, 0), (6, 0), (6, 3), (5, 3), (4, 1), (3, 3), (2, 1), (1, 3), (0, 3)];
    let vertices: String = comb.map(|(x, z)| format!("v {x} 0 {z}\n")).concat();
    let is_in = |x: f64, z: f64| {
        let mut is_in = false;
        for (at, (ax, az)) in comb.iter().enumerate() {
            let (bx, bz) = comb[(at + 1) % comb.len()];
            let [ax, az, bx, bz] = [*ax, *az, bx, bz].map(f64::from);
            if (az > z) != (bz > z) && x < ax + (bx - ax) * (z - az) / (bz - az) {
                is_in = !is_in;
            }
        }
        is_in
    };
    for first in 0..comb.len() {
        for reversed in [false, true] {
            let mut corners: Vec<usize> =
                (0..comb.len()).map(|k| 1 + (first + k) % comb.len()).collect();
            if reversed {
                corners.reverse();
            }
            let corners: Vec<String> = corners.iter().map(usize::to_string).collect();
            let face = corners.join(" ");
            let model = parse(&format!("mtllib m\nusemtl dark\n{vertices}f {face}\n")).unwrap();
            for (x, y) in points() {
                // The model's z is the world's -y.
                let (x, z) = (x + 3.0, y + 1.5);
                assert_eq!(covers(&model, x, -z), usize::from(is_in(x, z)), "{face} at {x}, {z}");
            }
            let up = if reversed { Vec3::Z } else { Vec3::NEG_Z };
            assert!(model.triangles.iter().all(|triangle| triangle.normal == up), "{face}");
        }
    }
}

#[test]
fn convex_faces_are_fans_about_their_first_corner() {
    let vertices = "v 0 0 0\nv 2 0 0\nv 3 0 1\nv 2 0 2\nv 1 0 2\nv 0 0 2\n";
    let model = parse(&format!("mtllib m\nusemtl dark\n{vertices}f 2 3 4 5 6 1\n")).unwrap();
    let firsts = model.triangles.iter().map(|triangle| triangle.vertices[0]);
    assert_eq!(firsts.collect::<Vec<_>>(), [DVec3::new(2.0, 0.0, 0.0); 4]);
}

#[test]
fn faces_whose_edges_cross_are_refused() {
    let star = "v 0 0 3\nv 2 0 -3\nv -3 0 1\nv 3 0 1\nv -2 0 -3\n";
    let spiral =
        "v 0 0 0\nv 4 0 0\nv 0 0 4\nv -4 0 0\nv 0 0 -4\nv 5 0 0\nv 0 0 5\nv -5 0 0\nv 0 0 -5\n";
    for (vertices, face) in [
        ("v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\n", "1 2 3 4"),
        ("v 0 0 0\nv 1 0 0\nv 0 0 2\nv 1 0 1\n", "1 2 3 4"),
        (star, "1 2 3 4 5"),
        (spiral, "2 3 4 5 6 7 4 5"),
        (spiral, "2 3 4 5 6 7 8 9"),
    ] {
        let error = parse(&format!("mtllib m\nusemtl dark\n{vertices}f {face}\n")).unwrap_err();
        assert!(error.contains("edges do not cross"), "{face}: {error}");
    }
}

#[test]
fn hash_is_a_comment_after_white_space_or_part_of_a_name() {
    for (from, to) in [
        ("f 1 2 3 4", "f 1 2 3 4 # the floor"),
        ("f 1 2 3 4", "f 1 2 3 4 #floor"),
        ("v 1 2 -1", "v 1 2 -1 #6"),
        ("usemtl bright", "usemtl bright # as it is called"),
        ("usemtl bright", "usemtl bright #1"),
        ("o floor", "o floor # one\no floor # two"),
        ("mtllib base.mtl", "  # nothing\n#nothing\nmtllib base.mtl"),
    ] {
        assert_as_base(parse(&BASE.replace(from, to)), to);
    }
    for materials in [
        MATERIALS.replace("newmtl bright", "newmtl bright # shiny"),
        MATERIALS.replace("0.9 0.9 0.9", "0.9 0.9 0.9 # nearly white"),
        MATERIALS.replace("0.9 0.9 0.9", "0.9 #gray"),
    ] {
        assert_as_base(parse_with(BASE, &materials), &materials);
    }
    let error = parse(&with_floor("f 1 2 3 4#1")).unwrap_err();
    assert!(error.contains("model:10: ") && error.contains("'4#1'"), "{error}");
}

#[test]
fn materials_whose_names_could_be_either_are_refused() {
    let materials = "newmtl gray #1\nKd 0.9\nnewmtl gray #2\nKd 0.1\nnewmtl dark\nKd 0.1\n";
    let text = |name: &str| BASE.replace("usemtl bright", &format!("usemtl {name}"));
    assert_as_base(parse_with(&text("gray #1"), materials), "gray #1");
    let error = parse_with(&text("gray"), materials).unwrap_err();
    assert!(error.contains("model:9: ") && error.contains("could be 'gray #1' or"), "{error}");
    let error = parse_with(&text("gray #3"), materials).unwrap_err();
    assert!(error.contains("model:9: ") && error.contains("'gray #3' is in no"), "{error}");
}

#[test]
fn materials_defined_twice_are_refused_where_they_differ() {
    let again = |kd: &str| parse_with(BASE, &format!("{MATERIALS}newmtl bright\nKd {kd}\n"));
    assert_as_base(again("0.9 0.9 0.9"), "the same");
    let error = again("0.5 0.5 0.5").unwrap_err();
    assert!(error.starts_with("base.mtl:6: "), "{error}");
    assert!(error.contains("'bright'"), "{error}");
}

#[test]
fn continued_lines_are_one() {
    for face in ["f 1 2 \\\n 3\\\n4", "f\\\n1 2 3 4", "f 1 2 3 \\  \n4", "f 1/1 2/2 3/3\\\r\n\t4/4"]
    {
        assert_as_base(parse(&with_floor(face)), face);
    }
    // A name may end like that, and so may a comment.
    for name in ["o C:\\models\\", "# C:\\models\\", "g a \\\nb"] {
        assert_as_base(parse(&BASE.replace("o floor", name)), name);
    }
    // Lines are counted as an editor counts them.
    let error = parse(&with_floor("f 1 2 \\\n3 9")).unwrap_err();
    assert!(error.starts_with("model:10: "), "{error}");
    let error = parse(&format!("{}f 1 2 9\n", with_floor("f 1 2 \\\n3 4"))).unwrap_err();
    assert!(error.starts_with("model:15: "), "{error}");
}

#[test]
fn line_ends_and_encodings() {
    let utf16 = |text: &str, big: bool| -> Vec<u8> {
        let bytes = |unit: u16| if big { unit.to_be_bytes() } else { unit.to_le_bytes() };
        text.encode_utf16().flat_map(bytes).collect()
    };
    let marked = format!("\u{feff}{BASE}");
    let with_cr = BASE.replace('\n', "\r");
    for (what, text) in [
        ("CR", with_cr.into_bytes()),
        ("CR LF", BASE.replace('\n', "\r\n").into_bytes()),
        ("byte order mark", format!("\u{feff}{BASE}").into_bytes()),
        ("UTF-16", utf16(&marked, false)),
        ("UTF-16, big-endian", utf16(&marked, true)),
        ("UTF-16 without a mark", utf16(BASE, false)),
        ("UTF-16 without a mark, big-endian", utf16(BASE, true)),
        ("Latin-1", [b"# \xe4\xf6\xfc\n", BASE.as_bytes()].concat()),
    ] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("model.obj"), text).unwrap();
        std::fs::write(folder.path().join("base.mtl"), MATERIALS.replace('\n', "\r")).unwrap();
        assert_as_base(
            obj::load(&folder.path().join("model.obj")).map_err(|error| error.to_string()),
            what,
        );
    }
}

#[test]
fn names_that_are_not_utf8_stay_apart() {
    let folder = tempfile::tempdir().unwrap();
    let renamed = |text: &str| {
        let bytes = text.replace("bright", "m\u{1}").replace("dark", "m\u{2}").into_bytes();
        let letter = |byte| match byte {
            1 => 0xe4,
            2 => 0xf6,
            _ => byte,
        };
        bytes.into_iter().map(letter).collect::<Vec<u8>>()
    };
    std::fs::write(folder.path().join("model.obj"), renamed(BASE)).unwrap();
    std::fs::write(folder.path().join("base.mtl"), renamed(MATERIALS)).unwrap();
    let model = obj::load(&folder.path().join("model.obj"));
    assert_as_base(model.map_err(|error| error.to_string()), "Latin-1 names");
}

#[test]
fn what_carries_geometry_is_read_refused_or_told() {
    let fo = field("fo2.obj").unwrap();
    assert_eq!(fo.mesh_objects.len(), 2);
    assert_eq!(fo.triangles.len(), 4);
    for surface in ["surf 0 1 0 1 1 2 3 4", "bzp 1 2 3 4", "res 1 2", "call other.obj", "csh ls"] {
        let error = parse(&format!("{BASE}{surface}\n")).unwrap_err();
        let keyword = surface.split(' ').next().unwrap();
        assert!(error.starts_with("model:14: ") && error.contains(keyword), "{error}");
    }
    // As somebody may write faces and vertices who never saw the format.
    for unknown in ["F 1 2 3", "face 1/1 2/1 3/1", "V 0 0 0", "vertex 1 2 3"] {
        let error = parse(&format!("{BASE}{unknown}\n")).unwrap_err();
        assert!(error.starts_with("model:14: "), "{error}");
    }
    let model = parse(&format!("{BASE}l 1 2\nl 2 3\np 1\ncreated by hand\n")).unwrap();
    assert_eq!(
        model.notes,
        [
            "model:14: 'l' is left out, here and 1 more times",
            "model:16: 'p' is left out",
            "model:17: 'created' is left out"
        ]
    );
    assert_as_base(parse(&format!("{BASE}s off\nvt 0 0\nlod 3\nmg 1 0.5\n")), "without area");
    let textured = format!("{MATERIALS}map_Kd wood.png\n");
    let notes = parse_with(BASE, &textured).unwrap().notes;
    assert_eq!(notes.len(), 1);
    assert!(notes[0].starts_with("base.mtl:5: ") && notes[0].contains("'dark'"), "{notes:?}");
}

#[test]
fn faces_that_are_not_flat_are_refused_with_the_line() {
    let bent = |corners: usize, height: f64, scale: f64| {
        let corner = |at: usize| {
            let angle = 0.3 + std::f64::consts::TAU * at as f64 / corners as f64;
            let height = if at == 1 { height } else { 0.0 };
            // In a plane that is no axis' own.
            let [x, y, z] =
                [angle.cos(), 0.4 * angle.cos() + height, angle.sin()].map(|x| scale * x);
            format!("v {x:.6} {y:.6} {z:.6}\n")
        };
        let vertices: String = (0..corners).map(corner).collect();
        let face: String = (1..=corners).map(|at| format!(" {at}")).collect();
        parse(&format!("mtllib m\n{vertices}usemtl dark\nf{face}\n"))
    };
    for corners in [4, 5, 12] {
        for scale in [0.01, 1.0, 1000.0] {
            assert!(bent(corners, 0.0, scale).is_ok(), "rounding is not a bend");
            for height in [0.3, 0.01, -0.01] {
                let error = bent(corners, height, scale).unwrap_err();
                assert!(error.starts_with(&format!("model:{}: ", corners + 3)), "{error}");
                assert!(error.contains("expected a flat face"), "{error}");
            }
        }
    }
}

#[test]
fn indices() {
    for face in ["f -6 -5 -4 -3", "f 1/7 2/8 3/9 4/10", "f 1// 2", "f 0 1 2", "f 1 2 7", "f -7 1 2"]
    {
        let found = parse(&with_floor(face));
        if face.starts_with("f -6") || face.starts_with("f 1/7") {
            assert_as_base(found, face);
        } else {
            assert!(found.unwrap_err().starts_with("model:10: "), "{face}");
        }
    }
    for face in ["f 1 2", "f 1.0 2 3", "f 1/x 2 3", "f 1/1/1/1 2 3", "f a b c", "f 1,2,3"] {
        assert!(parse(&with_floor(face)).unwrap_err().starts_with("model:10: "), "{face}");
    }
}

#[test]
fn vertices_with_more_than_three_numbers() {
    for more in ["1", "0.2 0.3 0.4", "1.0 0.2 0.3 0.4"] {
        let text = BASE.replace("v 1 2 -1", &format!("v 1 2 -1 {more}"));
        assert_as_base(parse(&text), more);
    }
    for more in ["2", "x", "0.5 1 1 1", "1 2 3 4 5", "1#"] {
        let text = BASE.replace("v 1 2 -1", &format!("v 1 2 -1 {more}"));
        assert!(parse(&text).unwrap_err().starts_with("model:7: "), "{more}");
    }
}

#[test]
fn responses() {
    let with = |kd: &str| parse_with(BASE, &MATERIALS.replace("0.9 0.9 0.9", kd));
    let floor = |kd: &str| with(kd).map(|model| surfaces(&model)[0].2);
    assert_eq!(floor("0.8"), Ok(Vec3::splat(0.8)));
    assert_eq!(floor("1.000000119 1.0000001 1"), Ok(Vec3::ONE));
    assert_eq!(floor("-0.0000001 0 0.5"), Ok(Vec3::new(0.0, 0.0, 0.5)));
    for wrong in
        ["1.1", "0.5 0.5", "-0.1 0 0", "0.5 0.5 0.5 0.5", "xyz 1 1 1", "spectral a.rfl", ""]
    {
        let error = floor(wrong).unwrap_err();
        assert!(error.starts_with("base.mtl:2: "), "{wrong}: {error}");
    }
}

#[test]
fn what_no_face_uses_may_be_anything() {
    for unused in ["usemtl nothing", "v nan nan nan", "v 1", "vn 0 0 0", "vn", "vt x"] {
        assert_as_base(parse(&format!("{BASE}{unused}\n")), unused);
    }
    let materials = format!("{MATERIALS}newmtl glass\nKd 7 7 7\nnewmtl metal\n");
    assert_as_base(parse_with(BASE, &materials), "unused materials");
    let used = BASE.replace("usemtl bright", "usemtl metal");
    let error = parse_with(&used, &materials).unwrap_err();
    assert!(error.starts_with("base.mtl:7: ") && error.contains("'metal'"), "{error}");
}

/// [`BASE`] with the line `mtllib`, in a folder with `libraries`.
fn with_libraries(mtllib: &str, libraries: &[(&str, &str)]) -> Result<Model, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| -> PathBuf { folder.path().join(name) };
    for (name, text) in libraries {
        std::fs::create_dir_all(path(name).parent().unwrap()).unwrap();
        std::fs::write(path(name), text).unwrap();
    }
    std::fs::write(path("model.obj"), BASE.replace("mtllib base.mtl", mtllib)).unwrap();
    obj::load(&path("model.obj")).map_err(|error| error.to_string())
}

#[test]
fn names_of_material_libraries() {
    let (bright, dark) = MATERIALS.split_at(MATERIALS.find("newmtl dark").unwrap());
    for (mtllib, libraries) in [
        ("mtllib my room.mtl", vec![("my room.mtl", MATERIALS)]),
        ("mtllib my room.mtl other.mtl", vec![("my room.mtl", bright), ("other.mtl", dark)]),
        ("mtllib a.mtl my room.mtl", vec![("my room.mtl", bright), ("a.mtl", dark)]),
        ("mtllib \"my room.mtl\"", vec![("my room.mtl", MATERIALS)]),
        ("mtllib files\\room.mtl", vec![("files/room.mtl", MATERIALS)]),
        ("mtllib room.mtl # the library", vec![("room.mtl", MATERIALS)]),
        ("mtllib room #1.mtl", vec![("room #1.mtl", MATERIALS), ("room", "Kd")]),
        ("mtllib a.mtl\nmtllib b.mtl", vec![("a.mtl", bright), ("b.mtl", dark)]),
    ] {
        assert_as_base(with_libraries(mtllib, &libraries), mtllib);
    }
    let two = with_libraries("mtllib b.mtl a.mtl", &[("a.mtl", bright), ("b.mtl", dark)]).unwrap();
    let names: Vec<_> = two.libraries.iter().filter_map(|path| path.file_name()).collect();
    assert_eq!(names, ["b.mtl", "a.mtl"]);
}

#[test]
fn material_libraries_that_cannot_be_read_name_the_line_of_the_model() {
    for (mtllib, libraries, expected) in [
        ("mtllib none.mtl", vec![], "none.mtl: cannot be read"),
        ("mtllib a.mtl none.mtl", vec![("a.mtl", MATERIALS)], "none.mtl: cannot be read"),
        ("mtllib a.mtl", vec![("a.mtl", "Kd 1 1 1\n")], "a.mtl:1: expected a 'newmtl'"),
        ("mtllib .", vec![], "found a folder, pipe or device"),
        ("mtllib a.mtl", vec![("a.mtl", "a\n\0\n")], "a.mtl:2: expected text"),
        ("mtllib", vec![], "expected the name of a file after 'mtllib'"),
    ] {
        let error = with_libraries(mtllib, &libraries).unwrap_err();
        assert!(error.contains(expected), "{mtllib}: {error}");
        assert!(error.contains("model.obj:1"), "{mtllib}: {error}");
    }
}

#[cfg(unix)]
#[test]
fn pipe_as_material_library_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("base.mtl");
    assert!(std::process::Command::new("mkfifo").arg(pipe).status().unwrap().success());
    std::fs::write(folder.path().join("model.obj"), BASE).unwrap();
    let error = obj::load(&folder.path().join("model.obj")).unwrap_err().to_string();
    assert!(error.contains("pipe") && error.contains("model.obj:1"), "{error}");
}
