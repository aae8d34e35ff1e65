//! Lists as other programs write them.

use std::path::Path;
use std::time::Instant;

use glam::Vec3;
use photon_list::ply;
use photon_list::reader::{Look, Notes, PhotonList, load, load_at_most, look};

/// So many rows are more than what is no list has.
const ROWS: usize = 30;

fn positions() -> Vec<Vec3> {
    (0..ROWS)
        .map(|row| Vec3::new(0.125 * row as f32 - 1.5, -0.25, 1.0 / (1 + row) as f32))
        .collect()
}

/// A line for each position, as `line` writes it.
fn lines(line: impl Fn(Vec3) -> String) -> String {
    positions().into_iter().map(|position| line(position) + "\n").collect()
}

fn rows(separator: &str) -> String {
    lines(|Vec3 { x, y, z }| format!("{x}{separator}{y}{separator}{z}"))
}

fn csv() -> String {
    format!("x,y,z\n{}", rows(","))
}

fn ply() -> String {
    format!("{}{}", ply_header("ascii", ROWS), rows(" "))
}

fn ply_header(format: &str, count: usize) -> String {
    let properties = "property float x\nproperty float y\nproperty float z\n";
    format!("ply\nformat {format} 1.0\nelement vertex {count}\n{properties}end_header\n")
}

fn with_file<T>(contents: impl AsRef<[u8]>, read: impl Fn(&Path) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list");
    std::fs::write(&path, contents).unwrap();
    read(&path)
}

/// What `compare` and `merge` read, and what `grade` reads.
fn read(
    contents: impl AsRef<[u8]>,
) -> (Result<PhotonList, String>, Result<(PhotonList, Notes), String>) {
    with_file(contents, |path| {
        let strict = load(path).map_err(|error| error.to_string());
        (strict, load_at_most(path, 1000).map_err(|error| error.to_string()))
    })
}

/// Checks that `contents` are the positions, for both.
fn assert_read(contents: impl AsRef<[u8]>, what: &str) {
    let (strict, lenient) = read(contents);
    let strict = strict.unwrap_or_else(|error| panic!("{what}: {error}"));
    let found: Vec<Vec3> = strict.records.iter().map(|record| record.position).collect();
    assert_eq!(found, positions(), "{what}");
    let (lenient, notes) = lenient.unwrap();
    assert_eq!(format!("{lenient:?}"), format!("{strict:?}"), "{what}");
    assert!(notes.left_out.is_empty(), "{what}");
}

/// Checks that both refuse `contents`, with all of `expected` in the message.
fn assert_refused(contents: impl AsRef<[u8]>, expected: &[&str]) {
    let (strict, lenient) = read(contents);
    for error in [strict.unwrap_err(), lenient.unwrap_err()] {
        for part in expected {
            assert!(error.contains(part), "expected '{part}' in: {error}");
        }
    }
}

#[test]
fn dialects_of_text() {
    let header = |header: &str| csv().replacen("x,y,z", header, 1);
    let quoted = |comma: &str| {
        let quoted = |number: f32| format!("\"{}\"", number.to_string().replace('.', comma));
        lines(|Vec3 { x, y, z }| [x, y, z].map(quoted).join(","))
    };
    let numbered = |first: usize, quote: &str, separator: &str| -> String {
        let rows = rows(separator);
        let number = |at: usize| format!("{quote}{}{quote}{separator}", first + at);
        rows.lines().enumerate().map(|(at, row)| number(at) + row + "\n").collect()
    };
    for (what, text) in [
        ("as it should be", csv()),
        (
            "comma at the end of a row",
            format!("x,y,z\n{}", lines(|v| format!("{},{},{},", v.x, v.y, v.z))),
        ),
        ("comma at the end of each row", csv().replace('\n', ",\n")),
        ("commas at the end", csv().replace('\n', ",,,\n")),
        ("rows of commas", csv() + ",,\n,,\n"),
        ("quoted decimal comma", format!("x,y,z\n{}", quoted(","))),
        ("quoted", format!("\"x\",\"y\",\"z\"\n{}", quoted("."))),
        ("quoted rows", csv().lines().map(|line| format!("\"{line}\"\n")).collect()),
        ("ParaView", header("\"Points:0\",\"Points:1\",\"Points:2\"")),
        ("ParaView from 5.11", header("Points_0,Points_1,Points_2")),
        ("CloudCompare", format!("//X Y Z\n{}", rows(" "))),
        ("CloudCompare, counted", format!("//X Y Z\n{ROWS}\n{}", rows(" "))),
        ("points of Leica", format!("{ROWS}\n{}", rows(" "))),
        ("R", format!("\"x\" \"y\" \"z\"\n{}", numbered(1, "\"", " "))),
        ("R, commas", format!("\"x\",\"y\",\"z\"\n{}", numbered(1, "\"", ","))),
        (
            "R, semicolons",
            format!("\"x\";\"y\";\"z\"\n{}", numbered(1, "\"", ";").replace('.', ",")),
        ),
        ("R, commas without quotes", format!("x,y,z\n{}", numbered(1, "", ","))),
        ("R, tabs", format!("x\ty\tz\n{}", numbered(1, "", "\t"))),
        ("pandas, printed", format!("   x   y  z\n{}", numbered(0, "", "  "))),
        ("NumPy", format!("# x y z\n{}", rows(" "))),
        ("MATLAB", format!("% x y z\n{}", rows("\t"))),
        ("comments of two kinds", format!("# x y z\n# of a run\n{}", rows(" "))),
        ("names twice", format!("# x, y, z\n{}", csv())),
        ("units", header("x (m),y (m),z (m)")),
        ("units in brackets", header("X [m],Y [Meters],Z [world units]")),
        ("indices", header("position[0],position[1],position[2]")),
        ("one comment at the end", csv() + "# 5001 photons\n"),
        ("comments between", csv().replacen('\n', "\n# one\n// two\n", 2)),
        ("empty first line", format!("\n  \n{}", csv())),
        ("empty lines between", csv().replace('\n', "\n\n")),
        ("CR", csv().replace('\n', "\r")),
        ("CR LF", csv().replace('\n', "\r\n")),
        ("CR CR LF", csv().replace('\n', "\r\r\n")),
        ("no end of line at the end", csv().trim_end().to_owned()),
        ("byte order mark", format!("\u{feff}{}", csv())),
        ("separator for Excel", format!("sep=,\n{}", csv())),
        ("semicolons", format!("x;y;z\n{}", rows(";").replace('.', ","))),
        ("decimal commas between spaces", rows(" ").replace('.', ",")),
        ("no names", rows(",")),
        (
            "comma in another name",
            format!("x\ty\tz\ta, b\n{}", rows("\t").replace('\n', "\tn, n\n")),
        ),
        (
            "semicolon in another name",
            csv()
                .replacen("z\n", "z,a;b\n", 1)
                .replace("5,", "5, ")
                .lines()
                .enumerate()
                .map(|(at, line)| if at == 0 { format!("{line}\n") } else { format!("{line},1\n") })
                .collect(),
        ),
    ] {
        assert_read(text, what);
    }
}

#[test]
fn coordinates_are_known_by_all_their_names() {
    for intensity in
        ["intensity.r,intensity.g,intensity.b", "Intensity[0],Intensity[1],Intensity[2]"]
    {
        let header = format!("x,y,z,{intensity},toLightRay.x,toLightRay.y,toLightRay.z");
        let list = read(format!("{header}\n1,2,3,4,5,6,0,0.6,0.8\n")).0.expect("it is a list");
        assert_eq!(list.records[0].intensity, Vec3::new(4.0, 5.0, 6.0), "{header}");
        assert_eq!(list.records[0].to_light, Vec3::new(0.0, 0.6, 0.8), "{header}");
    }
}

#[test]
fn encodings() {
    let utf16 = |text: &str, mark: bool, big: bool| -> Vec<u8> {
        let mark = mark.then_some(0xfeff_u16);
        let units = mark.into_iter().chain(text.encode_utf16());
        units.flat_map(|unit| if big { unit.to_be_bytes() } else { unit.to_le_bytes() }).collect()
    };
    for text in [csv(), ply(), csv().replace('\n', "\r\n")] {
        for (mark, big) in [(true, true), (true, false), (false, true), (false, false)] {
            assert_read(utf16(&text, mark, big), "UTF-16");
        }
    }
    let other = csv().replacen("x,y,z\n", "# hällo\nx,y,z\n", 1);
    let (latin1, _, _) = encoding_rs::WINDOWS_1252.encode(&other);
    assert_read(latin1, "Latin-1");
    let (latin1, _, _) = encoding_rs::WINDOWS_1252.encode("x,y,z,name\n1,2,3,hällo\n");
    assert!(read(latin1).0.is_ok());
    let utf32: Vec<u8> = csv().bytes().flat_map(|byte| [byte, 0, 0, 0]).collect();
    assert_refused(utf32, &["expected text, found a zero byte"]);
}

#[test]
fn dialects_of_ply() {
    let after_magic = |text: &str| ply().replacen("ply\n", &format!("ply\n{text}"), 1);
    for (what, text) in [
        ("as it should be", ply()),
        ("byte order mark", format!("\u{feff}{}", ply())),
        ("empty first line", format!("\n{}", ply())),
        ("capitals", ply().replacen("ply", "PLY", 1)),
        ("header in capitals", ply().replacen("element vertex", "ELEMENT VERTEX", 1)),
        ("space behind the first word", ply().replacen("ply", "ply ", 1)),
        ("CR", ply().replace('\n', "\r")),
        ("CR LF", ply().replace('\n', "\r\n")),
        ("empty lines between", ply().replace('\n', "\n\n")),
        ("comment", after_magic("comment made by hand\nobj_info none\n")),
        ("long comment", after_magic(&format!("comment {}\n", "x".repeat(60_000)))),
        (
            "camera before",
            ply()
                .replacen("element v", "element camera 2\nproperty float view_px\nelement v", 1)
                .replacen("end_header\n", "end_header\n1\n2\n", 1),
        ),
        (
            "faces before and behind",
            ply()
                .replacen("element v", "element face 1\nproperty list uchar int i\nelement v", 1)
                .replacen(
                    "end_header\n",
                    "element edge 1\nproperty int a\nend_header\n3 0 1 2\n",
                    1,
                )
                + "7\n",
        ),
        (
            "lists between",
            ply()
                .replacen("property float y", "property list uchar int n\nproperty float y", 1)
                .replace(" -0.25", " 2 8 9 -0.25"),
        ),
        ("element of nothing", ply().replacen("end_h", "element none 1000000000000\nend_h", 1)),
    ] {
        assert_read(text, what);
    }
    let (latin1, _, _) = encoding_rs::WINDOWS_1252.encode("comment hällo\n");
    assert_read([b"ply\n", &*latin1, &ply().as_bytes()[4..]].concat(), "Latin-1");
}

/// The positions in binary with big-endian order, with a list in each row and faces around.
fn binary(end: &str) -> Vec<u8> {
    let header = ply_header("binary_big_endian", ROWS)
        .replacen("element v", "element face 2\nproperty list uchar int i\nelement v", 1)
        .replacen("property float z", "property list ushort double n\nproperty float z", 1)
        .replacen("end_header", "element user 1\nproperty uchar u\nend_header", 1);
    let mut bytes = header.replace('\n', end).into_bytes();
    bytes.extend([1, 0, 0, 0, 1, 0]);
    for position in positions() {
        bytes.extend([position.x.to_be_bytes(), position.y.to_be_bytes()].as_flattened());
        bytes.extend([0, 2]);
        bytes.extend([7; 16]);
        bytes.extend(position.z.to_be_bytes());
    }
    bytes.push(b'\n');
    bytes
}

#[test]
fn binary_ply() {
    for end in ["\n", "\r\n", "\r"] {
        assert_read(binary(end), end);
    }
    // Behind CR alone, LF is data.
    let mut bytes = ply_header("binary_little_endian", 1).replace('\n', "\r").into_bytes();
    bytes.extend([0x0a, 0, 0, 0x3f, 0, 0, 0, 0, 0, 0, 0, 0]);
    let first = read(bytes).0.unwrap().records[0].position.x;
    assert_eq!(first.to_bits(), 0x3f00_000a);
}

#[test]
fn rows_beyond_or_below_the_count_are_refused_with_both_counts() {
    let counted = |count: usize| ply().replacen("vertex 30", &format!("vertex {count}"), 1);
    assert_refused(counted(0), &["after 0 photons", "found more: 30 rows"]);
    assert_refused(counted(10), &["after 10 photons", "found more: 20 rows"]);
    assert_refused(counted(31), &["expected 31 photons, found 30"]);
    let mut bytes = binary("\n");
    bytes.push(0);
    assert_refused(&bytes, &["after 30 photons", "found more: 1 bytes"]);
    assert_refused(&bytes[..bytes.len() - 3], &["expected 30 photons, found 29"]);
    assert_refused(format!("31\n{}", rows(" ")), &["line 1", "expected 31 photons, found 30"]);
    let huge =
        ply().replacen("end_h", "element face 1000000000000000000\nproperty int i\nend_h", 1);
    assert_refused(huge, &["expected 1000000000000000000 rows", "found 0"]);
}

#[test]
fn what_is_no_list_is_refused_with_the_line() {
    for (text, expected) in [
        ("x,y,z\n1,2,3\n1,2\n", ["line 3", "expected 3 values, found 2"]),
        ("x,y,z\n1,2,3,4\n", ["line 2", "expected 3 values, found 4"]),
        ("x y z\n1 1 2 3\n3 1 2 3\n", ["line 3", "expected 2, the number of the row"]),
        ("x y z\n5 1 2 3\n", ["line 2", "expected 3 values, found 4"]),
        ("x y z\n1 1 2 3 4\n", ["line 2", "expected 3 values, found 5"]),
        ("x,y,z\n1,2,3\n#NUM!,#NUM!,#NUM!\n", ["line 3", "found '#NUM!'"]),
        ("x;y;z\n1;2;3\n#ZAHL!;2;3\n", ["line 3", "found '#ZAHL!'"]),
        ("x,y,z\n1,2,3\n#N/A,2,3\n", ["line 3", "found '#N/A'"]),
        ("x,y,z\n1,2,3\n,,\n,,\n1,2,3\n", ["line 3", "only empty values"]),
        ("x\ty\tz\n1\t2\t3\n\t\t\n1\t2\t3\n", ["line 3", "only empty values"]),
        ("x,y,z\n1,2,3,4\n5,6,7,8\n", ["line 3", "expected 2, the number of the row"]),
        ("x,y,z\n1,2,3,,5\n", ["line 2", "expected 3 values, found 5"]),
        ("x,y,z\n1,2,3\n\"\"\"\",\"\"\"\",\"\"\"\"\n", ["line 3", "found '\"\"\"\"'"]),
        ("x y z\n0.5,0.25,0.125\n", ["line 2", "found '0.5,0.25,0.125'"]),
        ("x,y,z\n\"1,234,567\",2,3\n", ["'x'", "found '1,234,567'"]),
        ("\"x\",\"y\",\"z\"\n\"1\",1,2,3\n\"3\",1,2,3\n", ["line 3", "expected 2"]),
        ("x,y,z\n1,2,3 # last\n", ["line 2", "found '3 # last'"]),
        ("x,y,z\r1,2,3\r1,b,3\r", ["line 3", "found 'b'"]),
        ("x,y,z\n5001 photons stored\n", ["line 2", "expected"]),
        ("# nothing\n", ["photon list", "only comments"]),
        ("", ["empty", "nothing"]),
        (" \n\n", ["empty", "nothing"]),
        ("x,y\n1,2\n", ["line 1", "no 'z'"]),
        ("x,y,z,X (m),x\n1,2,3,4,5\n", ["line 1", "'x' twice"]),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int x\nend_header\n",
            ["expected", "no 'x'"],
        ),
        ("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n", ["line 4", "'half'"]),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int i\n",
            ["line 4", "whole"],
        ),
        (
            "ply\nformat ascii 1.0\nformat binary_little_endian 1.0\n",
            ["line 3", "found 'format binary_little_endian 1.0'"],
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x[mm]\nproperty float y\n\
             property float z\nend_header\n1 2 3\n",
            ["in meters", "found 'mm'"],
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
             property float z\nproperty list char int k\nend_header\n1 2 3 -1\n",
            ["line 9", "the length of the list 'k', found '-1'"],
        ),
        ("ply\nformat ascii 1.0\nelement vertex many\n", ["line 3", "'many'"]),
        ("ply\nformat ascii 1.0\n", ["line 2", "end_header"]),
    ] {
        assert_refused(text, &expected);
    }
    for wrong in ["1 2", "1 2 3 4", "1 b 3"] {
        assert_refused(format!("{}{wrong}\n", ply_header("ascii", 1)), &["line 8", "expected"]);
    }
    assert_refused("x".repeat(70_000), &["line 1", "65536 bytes in a line, found more"]);
    let header = "element vertex 1\nproperty list char uchar k\nproperty float x\n\
                  property float y\nproperty float z\nend_header\n";
    let mut bytes = format!("ply\nformat binary_little_endian 1.0\n{header}").into_bytes();
    bytes.extend([0xff; 13]);
    assert_refused(bytes, &["row 1", "the length of the list 'k', found '-1'"]);
}

#[test]
fn positions_in_other_units_than_meters_are_refused() {
    for unit in ["mm", "cm", "km", "in", "ft", "deg", "%", "Pa", "MM", "normalized", "m/s"] {
        let found = format!("found '{unit}'");
        for names in [
            format!("x ({unit}),y ({unit}),z ({unit})"),
            format!("x (m),y (m),z [{unit}]"),
            format!("Points:0 [{unit}],Points:1 [{unit}],Points:2 [{unit}]"),
        ] {
            assert_refused(format!("{names}\n{}", rows(",")), &["line 1", "in meters", &found]);
        }
        let commented = format!("run 1\nx[{unit}] y[{unit}] z[{unit}]\n");
        let commented = commented.lines().map(|line| format!("# {line}\n")).collect::<String>();
        assert_refused(commented.clone() + &rows(" "), &["line 2", "in meters", &found]);
        assert_refused(commented + &csv(), &["line 2", "in meters", &found]);
    }
}

#[test]
fn units_beside_names_are_read_if_they_are_meters() {
    let forms: [fn(&str, &str) -> String; 12] = [
        |axis, unit| format!("{axis}_{unit}"),
        |axis, unit| format!("{axis}.{unit}"),
        |axis, unit| format!("{axis}/{unit}"),
        |axis, unit| format!("{axis}:{unit}"),
        |axis, unit| format!("{axis}-{unit}"),
        |axis, unit| format!("{} in {unit}", axis.to_uppercase()),
        |axis, unit| format!("{axis}_in_{unit}"),
        |axis, unit| format!("{unit}_{axis}"),
        |axis, unit| format!("{axis} {{{unit}}}"),
        |axis, unit| format!("pos_{axis}_{unit}"),
        |axis, unit| format!("position.{axis} [{unit}]"),
        |axis, unit| format!("Points:{axis} {unit}"),
    ];
    let list = |form: fn(&str, &str) -> String, unit: &str, between: &str| {
        ["x", "y", "z"].map(|axis| form(axis, unit)).join(between) + "\n" + &rows(",")
    };
    for form in forms {
        for between in [",", ", "] {
            for unit in ["m", "M", "meters", "world"] {
                let list = list(form, unit, between);
                assert_read(&list, list.lines().next().unwrap());
            }
            for unit in ["mm", "cm", "CM", "ft", "inches", "millimeters", "px"] {
                let found = format!("found '{unit}'");
                assert_refused(list(form, unit, between), &["line 1", "in meters", &found]);
            }
        }
    }
    for (names, unit) in [("x_in,y_in,z_in", "in"), ("xmm,ymm,zmm", "mm"), ("x,y,z_cm", "cm")] {
        let found = format!("found '{unit}'");
        assert_refused(format!("{names}\n{}", rows(",")), &["line 1", "in meters", &found]);
    }
    // Inputs, and columns beside the position, have names of their own.
    let other = format!("x,y,z,x_in,time_mm\n{}", rows(",").replace('\n', ",7,7\n"));
    assert_eq!(notes(other), "unknown, so not judged: 'x_in', 'time_mm'");
    assert_refused(format!("in_x,in_y,in_z\n{}", rows(",")), &["found no 'x'"]);
}

#[test]
fn units_in_comments_are_meters() {
    let with = |comment: &str| {
        let ply = ply();
        [
            format!("# {comment}\n{}", csv()),
            format!("x,y,z\n// {comment}\n{}", rows(",")),
            ply.replacen("element", &format!("comment {comment}\nelement"), 1),
            ply.replacen("element", &format!("obj_info {comment}\nelement"), 1),
        ]
    };
    for (comment, unit) in [
        ("units: mm", "mm"),
        ("Unit = cm", "cm"),
        ("UNITS are millimetres", "millimetres"),
        ("units in mm", "mm"),
        ("all positions in centimeters, z up", "centimeters"),
        ("x, y, z (in mm)", "mm"),
    ] {
        for list in with(comment) {
            assert_refused(list, &["line ", "in meters", &format!("found '{unit}'")]);
        }
    }
    for comment in [
        "units: m",
        "unit meter, pictures are 20 cm wide",
        "positions in world units",
        "surface 3 lamp in mm",
        "rendered in 20 minutes, 3 cm per pixel",
    ] {
        let lists = with(comment);
        // Only lists of this program name surfaces.
        let is_surface = comment.starts_with("surface");
        for list in lists.into_iter().skip(if is_surface { 2 } else { 0 }) {
            assert_read(list, comment);
        }
    }
}

#[test]
fn optional_columns_that_cannot_be_used_are_left_out_by_grade_alone() {
    let surfaces = format!("x,y,z,surface,bounce\n{}", rows(",").replace('\n', ",shortBox,2\n"));
    let photons = format!("x,y,z,photon\n{}", rows(",").replace('\n', ",-1\n"));
    let last = format!("x,y,z,bounce\n{}", rows(",").replace('\n', ",1\n")) + "0,0,0,70000\n";
    let thousands = "x,y,z,photon\n1,2,3,\"1,007\"\n".to_owned();
    let semicolons = "x;y;z;bounce\n1;2;3;1,000\n".to_owned();
    let vector = "x,y,z,intensity_r,intensity_g,intensity_b\n1,2,3,1,1,none\n".to_owned();
    let of_ply = ply()
        .replacen("property float x", "property int photon\nproperty float x", 1)
        .replace("\n-", "\n-1 -")
        .replacen("end_header\n", "end_header\n-1 ", 1)
        .replacen("-1 -1 ", "-1 ", 1);
    for (text, column, place, found) in [
        (surfaces, "surface", "line 2", "'shortBox'"),
        (photons, "photon", "line 2", "'-1'"),
        (last, "bounce", "line 32", "'70000'"),
        (thousands, "photon", "line 2", "'1,007'"),
        (semicolons, "bounce", "line 2", "'1,000'"),
        (vector, "intensity_b", "line 2", "'none'"),
    ] {
        let (strict, lenient) = read(&text);
        let error = strict.unwrap_err();
        assert!(error.contains(place) && error.contains(found), "{error}");
        let (list, notes) = lenient.unwrap();
        assert_eq!(notes.left_out.len(), 1);
        let note = notes.left_out[0].to_string();
        let parts = [format!("'{column}' is left out"), place.to_owned(), found.to_owned()];
        assert!(parts.iter().all(|part| note.contains(part)), "{note}");
        let columns = list.columns;
        let has = [columns.surface, columns.photon, columns.intensity, columns.bounce];
        let others = usize::from(column == "surface");
        assert_eq!(has.iter().filter(|has| **has).count(), others, "{column}");
        assert!(list.records.iter().all(|record| record.photon == u32::MAX), "all are forgotten");
        assert!(list.records.iter().all(|record| record.bounce == 2 || record.bounce == u16::MAX));
    }
    let (strict, _) = read(of_ply);
    assert!(strict.is_err());
}

#[test]
fn numbers_that_are_none() {
    let spellings = ["nan", "-nan", "nan(ind)", "-nan(ind)", "1.#IND", "-1.#IND00", "1.#QNAN"];
    for spelling in spellings {
        let list = read(format!("x,y,z\n{spelling},1,2\n")).0.unwrap();
        assert!(list.records[0].position.x.is_nan(), "{spelling}");
    }
    for (spelling, value) in [
        ("inf", f32::INFINITY),
        ("-inf", f32::NEG_INFINITY),
        ("1.#INF", f32::INFINITY),
        ("-1.#INF00", f32::NEG_INFINITY),
        ("1.#J", f32::INFINITY),
    ] {
        let list = read(format!("x,y,z\n{spelling},1,2\n")).0.unwrap();
        assert_eq!(list.records[0].position.x, value, "{spelling}");
    }
}

#[test]
fn comments_of_a_header() {
    let path =
        |text: &str| with_file(text, |path| ply::comments(path).map_err(|error| error.to_string()));
    let text = ply().replacen("end_header", "comment a  b \nCOMMENT c\nend_header", 1);
    assert_eq!(path(&text).unwrap(), ["a  b", "c"]);
    assert!(path(&csv()).unwrap_err().contains("expected a PLY list"));
}

#[test]
fn what_looks_like_a_list() {
    let looks = |text: &str| with_file(text, |path| look(path).unwrap());
    let mesh = ply().replacen("end_h", "element face 1\nproperty list uchar int i\nend_h", 1);
    for (text, expected) in [
        (csv(), Look::List),
        (ply(), Look::List),
        (rows(" "), Look::List),
        (lines(|_| "nan,nan,nan".to_owned()), Look::List),
        (mesh + "3 0 1 2\n", Look::Unlikely),
        ("0 1.5 4\n".to_owned(), Look::Unlikely),
        ("x,y,z\n0,1.5,4\n".to_owned(), Look::Unlikely),
        ("x,y,z\n".to_owned(), Look::Unlikely),
        (lines(|v| format!("{} 480 {}", 100.0 + v.x, v.y)), Look::Unlikely),
        ("notes\n".to_owned(), Look::Other),
        (String::new(), Look::Other),
        ("v 0 0 1\nv 1 0 1\n".to_owned(), Look::Other),
    ] {
        assert_eq!(looks(&text), expected, "{text}");
    }
}

#[cfg(unix)]
#[test]
fn pipes_with_names_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("list.csv");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for error in [load(&pipe).unwrap_err(), load_at_most(&pipe, 1).unwrap_err()] {
        assert!(error.to_string().contains("pipe"), "{error}");
    }
}

#[test]
fn work_is_bounded_by_bytes() {
    let comment = format!("# {}\n", "x,".repeat(30_000));
    let wide = format!("x,y,z{}\n", ",a".repeat(30_000));
    for text in [
        comment.repeat(100),
        "#,,\n".repeat(1_500_000),
        "\n".repeat(6_000_000),
        wide.clone() + &("1,2,3".to_owned() + &",4".repeat(30_000) + "\n").repeat(70),
        format!("x,y,z\n{}", (",".repeat(60_000) + "\n").repeat(100)),
        format!("x,y,z\n{}", ("1,2,3".to_owned() + &",".repeat(60_000) + "\n").repeat(100)),
        format!("x,y,z\n{}", "# x y z\n".repeat(700_000)),
        format!(
            "ply\nformat ascii 1.0\n{}",
            (0..80_000).map(|at| format!("element {at:064} 0\n")).collect::<String>()
        ),
    ] {
        let text = text.repeat(4);
        let start = Instant::now();
        let _ = with_file(&text, |path| load_at_most(path, 1000).map(|_| ()));
        let seconds = start.elapsed().as_secs();
        // A quarter of a second on a busy machine.
        assert!(seconds < 5, "{seconds} s for {}", &text[..20]);
    }
}

/// A column that means something else to its writer must not be passed over in silence.
#[test]
fn columns_of_other_names_are_reported() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let notes_of = |header: &str, row: &str| {
        let path = folder.path().join("list.csv");
        let rows = lines(|Vec3 { x, y, z }| format!("{x},{y},{z}{row}"));
        std::fs::write(&path, format!("{header}\n{rows}")).expect("can be written");
        let (_, notes) = load_at_most(&path, usize::MAX).expect("it is a list");
        notes.guessed.unwrap_or_default()
    };
    assert_eq!(notes_of("x,y,z,dx,r", ",1,2"), "unknown, so not judged: 'dx', 'r'");
    assert_eq!(notes_of("x,y,z,bounce,nx,red", ",1,0,9"), "");
    assert_eq!(notes_of(",x,y,z", ",0"), "unknown, so not judged: one without a name");
    assert_eq!(
        notes_of("x,y,z,intensity_r,to_light_x,to_light_y", ",1,0,9"),
        "without the other two of their three, so not judged: 'intensity_r', 'to_light_x', \
         'to_light_y'"
    );
}

/// The remarks on `contents`, which are a list.
fn notes(contents: impl AsRef<[u8]>) -> String {
    read(contents).1.expect("it is a list").1.guessed.unwrap_or_default()
}

#[test]
fn what_is_passed_over_is_reported() {
    assert_eq!(notes(csv()), "");
    assert_eq!(notes(csv() + ",,\n"), "1 row of only empty values, from line 32 on");
    let tabs = csv().replace(',', "\t");
    let remark = "tabs between values; 1 row of only empty values, from line 33 on";
    assert_eq!(notes(tabs + " \n\t\t\n"), remark);
    let many = csv() + &",,\n\"\",\"\",\"\"\n".repeat(20_000);
    assert_eq!(notes(many), "40000 rows of only empty values, from line 32 on");
    let more = "element photon 1\nproperty float x\nelement face 1\nproperty int i\nend_h";
    let other = ply().replacen("end_h", more, 1) + "0.5\n7\n";
    assert_eq!(notes(other), "elements other than 'vertex', so not judged: 'photon' (1 rows)");
    let listed = ply()
        .replacen("property float y", "property list uchar int y_of\nproperty float y", 1)
        .replace(" -0.25", " 0 -0.25");
    assert_eq!(notes(listed), "unknown, so not judged: 'list y_of'");
}
