//! `compare` as a user runs it.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{fails, folder, json, reference_csv, run_line, stdout};
use serde_json::Value;

/// The reference list of 20,000 photons with the lines changed by `change` (the header first),
/// written beside it.
fn changed(reference: &Path, name: &str, change: impl FnOnce(&mut Vec<String>)) -> PathBuf {
    let text = fs::read_to_string(reference).expect("the list can be read");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    change(&mut lines);
    let path = reference.with_file_name(name);
    fs::write(&path, lines.join("\n") + "\n").expect("the list can be written");
    path
}

/// Line `line` with column `column` set to `value`.
fn with_cell(line: &str, column: usize, value: &str) -> String {
    let mut cells: Vec<_> = line.split(',').collect();
    cells[column] = value;
    cells.join(",")
}

/// The columns `columns` of every line.
fn keep_columns(lines: &mut Vec<String>, columns: &[usize]) {
    for line in lines {
        let cells: Vec<_> = line.split(',').collect();
        let kept: Vec<_> = columns.iter().map(|column| cells[*column]).collect();
        *line = kept.join(",");
    }
}

fn positions_only(lines: &mut Vec<String>) {
    keep_columns(lines, &[0, 1, 2]);
}

fn count(report: &Value, name: &str) -> u64 {
    report[name].as_u64().unwrap_or_else(|| panic!("{name}: expected a count in {report}"))
}

/// Matched, missing, extra and moved.
fn counts(report: &Value) -> [u64; 4] {
    ["matched", "missing", "extra", "moved"].map(|name| count(report, name))
}

#[test]
fn the_same_list_is_identical_in_either_format() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let line = "render --quiet --json --size 1x1 --photons 20000 --out {}";
    let summary = json(run_line(line, &[folder.path()]).success());
    let ply = folder.path().join("photons.ply");
    let text = stdout(run_line("compare {} {}", &[&csv, &ply]).code(0));
    assert!(text.starts_with("identical: "), "{text}");
    assert!(text.contains(summary["sha256"].as_str().expect("a hash")), "{text}");
    let line = "compare --json --photons 20000 {}";
    let report = json(run_line(line, &[&ply]).code(0));
    assert_eq!(report["outcome"], "identical");
    assert_eq!(report["sha256"], summary["sha256"]);
    assert_eq!(count(&report, "matched"), count(&summary, "stored"));
}

#[test]
fn rounding_stays_within_the_tolerance() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let rounded = changed(&csv, "rounded.csv", |lines| {
        let x: f32 = lines[5].split(',').next().expect("x").parse().expect("a number");
        lines[5] = with_cell(&lines[5], 0, &(x + 1e-5).to_string());
    });
    let report = json(run_line("compare --json {} {}", &[&csv, &rounded]).code(0));
    assert_eq!(report["outcome"], "within-tolerance");
    let report = json(run_line("compare --json --tolerance 0 {} {}", &[&csv, &rounded]).code(1));
    assert_eq!(count(&report, "moved"), 1);
}

/// The point of it all: one missing record puts none of those after it out of step.
#[test]
fn missing_extra_and_moved_records_are_counted_with_and_without_numbers() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let stored = fs::read_to_string(&csv).expect("the list").lines().count() as u64 - 1;
    let edit = |lines: &mut Vec<String>| {
        // From the end on, so that the numbers of the lines stay right.
        lines[700] = with_cell(&lines[700], 2, "0.777");
        lines.insert(500, with_cell(&lines[400], 0, "0.123"));
        lines.remove(300);
        lines.remove(10);
    };
    let numbered = changed(&csv, "numbered.csv", edit);
    let positions = changed(&csv, "positions.csv", |lines| {
        edit(lines);
        positions_only(lines);
    });
    let without_bounce = changed(&csv, "without_bounce.csv", |lines| {
        edit(lines);
        keep_columns(lines, &[9, 0, 1, 2]);
    });
    for list in [&numbered, &positions, &without_bounce] {
        let report = json(run_line("compare --json --photons 20000 {}", &[list]).code(1));
        assert_eq!(counts(&report), [stored - 3, 2, 1, 1], "{}", list.display());
    }
    // Where photons are numbered, their order in the file means nothing.
    let reversed = changed(&csv, "reversed.csv", |lines| lines[1..].reverse());
    run_line("compare {} {}", &[&csv, &reversed]).code(0);
}

#[test]
fn the_first_divergence_is_explained_from_the_path() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let shorter = changed(&csv, "shorter.csv", |lines| {
        lines.remove(1);
    });
    let first = fs::read_to_string(&csv).expect("the list").lines().nth(1).map(str::to_owned);
    let first = first.expect("a record");
    let photon: u64 = first.split(',').nth(9).expect("a photon").parse().expect("a number");
    let line = "compare --json --photons 20000 {}";
    let divergence = &json(run_line(line, &[&shorter]).code(1))["first_divergence"];
    assert_eq!((divergence["photon"].as_u64(), &divergence["bounce"]), (Some(photon), &1.into()));
    assert_eq!(divergence["section"], "Photon Scattering/Absorption");
    assert!(divergence["reference"].as_str().expect("text").contains("< P_r"), "{divergence}");

    let line = "compare --json --allow 0.01 --photons 20000 {}";
    assert_eq!(json(run_line(line, &[&shorter]).code(0))["outcome"], "within-tolerance");
    let text = stdout(run_line("compare --allow 0.01 {} {}", &[&csv, &shorter]).code(0));
    assert!(text.starts_with("the same but for the few"), "{text}");

    // A CSV file does not name its run; without it, the records alone are told.
    let report = json(run_line("compare --json --seed 7 {} {}", &[&csv, &shorter]).code(1));
    assert!(report["first_divergence"]["section"].is_null());
    assert!(report["note"].as_str().expect("a note").contains("--seed"));
}

/// `edit` is done to the cells of every line below the header.
fn edited(reference: &Path, name: &str, edit: impl Fn(&mut Vec<String>)) -> PathBuf {
    changed(reference, name, |lines| {
        for line in &mut lines[1..] {
            let mut cells: Vec<_> = line.split(',').map(str::to_owned).collect();
            edit(&mut cells);
            *line = cells.join(",");
        }
    })
}

#[test]
fn other_axes_and_photons_counted_from_1_are_said_and_compared() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let negative = |cell: &str| cell.strip_prefix('-').map_or(format!("-{cell}"), str::to_owned);
    let y_up = edited(&csv, "y_up.csv", |cells| {
        for first in [0, 6] {
            let z = cells.remove(first + 2);
            cells.insert(first + 1, z);
            cells[first + 2] = negative(&cells[first + 2]);
        }
    });
    let from_1 = edited(&csv, "from_1.csv", |cells| {
        cells[9] = (cells[9].parse::<u32>().expect("a number") + 1).to_string();
    });
    // Photons on the floor stay where they are.
    let z_down = edited(&csv, "z_down.csv", |cells| {
        for z in [2, 8] {
            cells[z] = negative(&cells[z]);
        }
    });
    let from_0 = edited(&csv, "from_0.csv", |cells| {
        cells[10] = (cells[10].parse::<u32>().expect("a number") - 1).to_string();
    });
    for (list, note) in [
        (&y_up, "axes are y-up"),
        (&z_down, "axes are others: (x, y, -z)"),
        (&from_1, "photon is shifted by 1"),
        (&from_0, "'bounce' differs in "),
    ] {
        let report = json(run_line("compare --json --photons 20000 {}", &[list]).code(0));
        assert_eq!(report["outcome"], "within-tolerance", "{note}");
        assert!(report["note"].as_str().expect("a note").contains(note), "{report}");
    }
    // What is wrong besides is still found.
    let both = edited(&from_1, "both.csv", |cells| cells[3] = "0.5".to_owned());
    let report = json(run_line("compare --json --photons 20000 {}", &[&both]).code(1));
    assert_eq!(count(&report, "wrong_intensity"), count(&report, "reference_records"));
}

#[test]
fn a_list_of_another_seed_is_called_so() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let positions = changed(&csv, "positions.csv", positions_only);
    let line = "compare --json --seed 149 --photons 20000 {}";
    let report = json(run_line(line, &[&positions]).code(1));
    assert_eq!(report["random_numbers"], "perhaps-other");
    assert!(report["first_divergence"].is_null(), "{report}");
    // A list that tells its photons leaves no doubt. What to do is said.
    for (list, told) in [(&positions, "as if they drew"), (&csv, "The two lists draw")] {
        let line = "compare --seed 149 --photons 20000 {}";
        let text = stdout(run_line(line, &[list]).code(1));
        assert!(text.contains(&format!("{told} different random numbers")), "{text}");
        assert!(text.contains("photon-mapping grade") && text.contains("reference_rand.hpp"));
        assert!(!text.contains("first divergence"), "{text}");
    }
}

/// Whose runs nobody knows. Photons that are all moved are those of the reference.
#[test]
fn lists_that_share_no_photon_seem_to_draw_other_numbers() {
    let folder = folder();
    let list = |seed: &str| {
        let out = folder.path().join(seed);
        let line = "render --format csv --quiet --size 1x1 --photons 20000 --seed {} --out {}";
        run_line(line, &[Path::new(seed), &out]).success();
        out.join("photons.csv")
    };
    let (left, right) = (list("5"), list("6"));
    let text = stdout(run_line("compare {} {}", &[&left, &right]).code(1));
    assert!(text.contains("as if they drew different random numbers"), "{text}");
    assert!(!text.contains("first divergence"), "{text}");
    let moved = edited(&left, "moved.csv", |cells| {
        cells[2] = (cells[2].parse::<f32>().expect("a number") + 0.05).to_string();
    });
    let report = json(run_line("compare --json {} {}", &[&left, &moved]).code(1));
    assert_eq!(report["random_numbers"], "same");
    assert_eq!(count(&report, "moved"), count(&report, "reference_records"));
    assert!(report["first_divergence"].is_object(), "{report}");
}

#[test]
fn a_ply_list_names_its_run() {
    let folder = folder();
    let line = "render --quiet --size 1x1 --seed 5 --photons 20000 --max-bounces 9 --out {}";
    run_line(line, &[folder.path()]).success();
    let ply = folder.path().join("photons.ply");
    let csv = folder.path().join("letter");
    let line = "render --quiet --size 1x1 --seed 5 --photons 20000 --max-bounces 9 \
                --letter-of-the-handout --out {}";
    run_line(line, &[&csv]).success();
    let report = json(run_line("compare --json {} {}", &[&ply, &csv.join("photons.ply")]).code(0));
    assert_eq!(report["outcome"], "same-under-another-reading");
    let reading = "t and b to the letter of the handout, not normalized";
    assert_eq!(report["reading"], reading);
    assert_eq!(report["first_divergence"]["section"], "Hemisphere Ray Transformation");
}

#[test]
fn wrong_values_are_counted_and_are_matters_of_storage() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let intensity = changed(&csv, "intensity.csv", |lines| {
        for line in &mut lines[1..] {
            *line = with_cell(line, 4, "0.5");
        }
    });
    let report = json(run_line("compare --json --photons 20000 {}", &[&intensity]).code(1));
    assert_eq!(count(&report, "wrong_intensity"), count(&report, "reference_records"));
    assert_eq!(count(&report, "matched"), count(&report, "reference_records"));
    assert_eq!(report["first_divergence"]["section"], "Photon Storage");
    let to_light = changed(&csv, "to_light.csv", |lines| {
        lines[3] = with_cell(&lines[3], 7, "0.5");
        lines[4] = with_cell(&lines[4], 7, "nan");
    });
    let report = json(run_line("compare --json --photons 20000 {}", &[&to_light]).code(1));
    assert_eq!(count(&report, "wrong_to_light"), 2);
}

#[test]
fn what_is_not_a_number_is_counted() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    for with_numbers in [true, false] {
        let list = changed(&csv, "nan.csv", |lines| {
            for line in &mut lines[20..40] {
                *line = with_cell(line, 0, "-nan(ind)");
            }
            if !with_numbers {
                positions_only(lines);
            }
        });
        let report = json(run_line("compare --json --photons 20000 {}", &[&list]).code(1));
        assert_eq!((count(&report, "not_finite"), count(&report, "moved")), (20, 20));
        run_line("compare {} {}", &[&list, &list]).code(0);
    }
}

#[test]
fn empty_lists_can_be_compared() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let empty = changed(&csv, "empty.csv", |lines| lines.truncate(1));
    run_line("compare {} {}", &[&empty, &empty]).code(0);
    let report = json(run_line("compare --json {} {}", &[&csv, &empty]).code(1));
    assert_eq!(count(&report, "missing"), count(&report, "reference_records"));
    run_line("compare {} {}", &[&empty, &csv]).code(1);
}

#[test]
fn pictures_are_compared_dot_by_dot() {
    let folder = folder();
    let render = |name: &str, photons: &str| {
        let out = folder.path().join(name);
        let line = "render --quiet --size 160x120 --photons {} --out {}";
        run_line(line, &[Path::new(photons), &out]).success();
        out.join("assignment8.png")
    };
    let (few, many) = (render("few", "20000"), render("many", "40000"));
    run_line("compare {} {}", &[&few, &few]).code(0);
    let out = folder.path().join("difference.png");
    let report = json(run_line("compare --json {} {} --out {}", &[&few, &many, &out]).code(1));
    let extra = count(&report, "dots_extra");
    assert!(extra > 10, "{report}");
    assert_eq!(count(&report, "dots_missing"), 0);
    assert_eq!(count(&report, "differing_pixels"), extra);
    let picture = image::open(&out).expect("a picture").into_rgb8();
    let red = picture.pixels().filter(|pixel| pixel.0 == [255, 0, 0]).count() as u64;
    assert_eq!(red, extra);
    let page = folder.path().join("difference.html");
    run_line("compare {} {} --out {}", &[&few, &many, &page]).code(1);
    let page = fs::read_to_string(page).expect("a page");
    assert_eq!(page.matches("src=\"data:image/png").count(), 3);
    assert!(page.contains("blue: missing dot") && page.contains(&format!("extra    {extra}")));
    let text = stdout(run_line("compare {} {}", &[&many, &few]).code(1));
    assert!(text.contains(&format!("missing  {extra}")), "{text}");
    let [enough, too_few] = [extra, extra - 1].map(|count| count.to_string());
    let line = "compare --dots {} {} {}";
    let text = stdout(run_line(line, &[Path::new(&enough), &many, &few]).code(0));
    assert!(text.starts_with("the same but for the few dots"), "{text}");
    run_line(line, &[Path::new(&too_few), &many, &few]).code(1);
    let small = folder.path().join("small");
    run_line("render --quiet --size 8x6 --photons 10 --out {}", &[&small]).success();
    let text = stdout(run_line("compare {} {}", &[&few, &small.join("assignment8.png")]).code(1));
    assert!(text.contains("160 x 120") && text.contains("8 x 6"), "{text}");
}

#[test]
fn bad_input_is_refused_in_one_line() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 1000);
    let picture = folder.path().join("assignment8.png");
    let garbage = folder.path().join("garbage.csv");
    fs::write(&garbage, "x,y\n1,2\n").expect("can be written");
    let broken = folder.path().join("broken.png");
    fs::write(&broken, b"\x89PNG\r\n\x1a\nnothing").expect("can be written");
    let nowhere = folder.path().join("nowhere.csv");
    fails("compare", &[], &["<FILE>"]);
    fails("compare {}", &[&csv], &["--seed", "REFERENCE"]);
    fails("compare {} {}", &[&csv, &nowhere], &["nowhere.csv", "cannot be read"]);
    fails("compare --seed 1 {}", &[&nowhere], &["nowhere.csv", "cannot be read"]);
    fails("compare {} {}", &[&csv, &garbage], &["garbage.csv", "'z'"]);
    fails("compare {} {}", &[&csv, folder.path()], &["cannot be read"]);
    fails("compare {} {}", &[&csv, &picture], &["photons.csv", "expected a picture"]);
    fails("compare --seed 1 {}", &[&picture], &["expected a photon list"]);
    fails("compare {} {}", &[&picture, &broken], &["broken.png", "PNG"]);
    fails("compare {} {} --out x.png", &[&csv, &csv], &["--out", "pictures"]);
    fails("compare {} {} --tolerance 2", &[&csv, &csv], &["--tolerance", "from 0 to 1"]);
    fails("compare {} {} {}", &[&csv, &csv, &csv], &["photons.csv"]);
}

/// The handout's box, `scale` times as large, beside its list of 20,000 photons.
fn scaled_box(folder: &Path, scale: f64) -> (PathBuf, String, PathBuf) {
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../model/assets/cornell_box.obj");
    let text = fs::read_to_string(model).expect("the model can be read");
    let scaled = |line: &str| match line.strip_prefix("v ") {
        Some(rest) => rest.split_whitespace().fold("v".to_owned(), |line, number| {
            let number: f64 = number.parse().expect("a number");
            format!("{line} {}", number * scale)
        }),
        None => line.to_owned(),
    };
    let lines: Vec<_> = text.lines().map(scaled).collect();
    let model = folder.join("scaled.obj");
    fs::write(&model, lines.join("\n") + "\n").expect("the model can be written");
    let materials = "cornell_box.mtl";
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../model/assets");
    fs::copy(source.join(materials), folder.join(materials)).expect("the materials can be copied");
    let light = format!("0,0,{}", 1.5 * scale);
    let line = "render --format csv --quiet --size 1x1 --photons 20000 --scene {} --light {} \
                --out {}";
    run_line(line, &[&model, Path::new(&light), folder]).success();
    (model, light, folder.join("photons.csv"))
}

#[test]
fn the_tolerance_grows_with_the_scene() {
    let line = "compare --json --photons 20000 --scene {} --light {} {}";
    let small = folder();
    let (model, light, csv) = scaled_box(small.path(), 1e-4);
    let zeros = changed(&csv, "zeros.csv", |lines| {
        positions_only(lines);
        lines[1..].iter_mut().for_each(|line| *line = "0,0,0".to_owned());
    });
    let report = json(run_line(line, &[&model, Path::new(&light), &zeros]).code(1));
    assert_eq!(count(&report, "matched"), 0);

    let large = folder();
    let (model, light, csv) = scaled_box(large.path(), 1e4);
    let moved = changed(&csv, "moved.csv", |lines| {
        for line in &mut lines[1..] {
            let x: f32 = line.split(',').next().expect("x").parse().expect("a number");
            *line = with_cell(line, 0, &(x + 0.05).to_string());
        }
    });
    let report = json(run_line(line, &[&model, Path::new(&light), &moved]).code(0));
    assert_eq!(report["outcome"], "within-tolerance");
}

#[test]
fn of_a_hit_straight_from_the_light_the_truth_is_told() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let direct = changed(&csv, "direct.csv", |lines| {
        let record = with_cell(&lines[1], 10, "0");
        lines.insert(1, with_cell(&record, 0, "0.5"));
    });
    let report = json(run_line("compare --json --photons 20000 {}", &[&direct]).code(1));
    let divergence = &report["first_divergence"];
    assert_eq!(divergence["bounce"], 0);
    let text = divergence["reference"].as_str().expect("text");
    assert!(text.starts_with("does not store the hit straight from the light"), "{text}");
    assert!(text.contains("scatters there") && text.contains("< P_r"), "{text}");
}

#[test]
fn a_doubled_list_is_stored_twice() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let doubled = changed(&csv, "doubled.csv", |lines| {
        let records = lines[1..].to_vec();
        lines.extend(records);
    });
    let report = json(run_line("compare --json --photons 20000 {}", &[&doubled]).code(1));
    assert_eq!(report["first_divergence"]["section"], "Photon Storage");
    assert_eq!(report["first_divergence"]["reason"], "the photon is stored twice");
    assert!(report["reading"].is_null(), "{report}");
}

#[test]
fn another_limit_or_count_is_called_so() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let limited = changed(&csv, "limited.csv", |lines| {
        lines.retain(|line| {
            !line.split(',').nth(10).expect("a bounce").parse().is_ok_and(|b: u32| b > 1)
        });
    });
    let report = json(run_line("compare --json --photons 20000 {}", &[&limited]).code(1));
    let divergence = &report["first_divergence"];
    assert_eq!(divergence["section"], "Photon Storage");
    assert!(divergence["reason"].as_str().expect("text").contains("after 1 bounces"));
    let line = "compare --json --photons 40000 {}";
    let divergence = &json(run_line(line, &[&csv]).code(1))["first_divergence"];
    assert_eq!(divergence["section"], "Photon Emission");
    assert!(divergence["reason"].as_str().expect("text").contains("about 20,000 photons"));
}

#[test]
fn the_order_of_records_without_numbers_means_nothing() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let reversed = changed(&csv, "reversed.csv", |lines| {
        positions_only(lines);
        lines[1..].reverse();
    });
    let report = json(run_line("compare --json --photons 20000 {}", &[&reversed]).code(0));
    assert_eq!(report["outcome"], "within-tolerance");
    assert_eq!(report["note"], "the same photons in another order");
    // Rounded to two decimals, photons have others nearby, which must leave them theirs.
    let rounded = changed(&csv, "rounded.csv", |lines| {
        positions_only(lines);
        lines[1..].reverse();
        for line in &mut lines[1..] {
            let round = |cell: &str| format!("{:.2}", cell.parse::<f32>().expect("a number"));
            *line = line.split(',').map(round).collect::<Vec<_>>().join(",");
        }
    });
    let line = "compare --json --tolerance 0.005 --photons 20000 {}";
    let report = json(run_line(line, &[&rounded]).code(0));
    assert_eq!(counts(&report)[1..], [0, 0, 0], "{report:#}");
    let fewer = changed(&reversed, "fewer.csv", |lines| {
        lines.remove(9);
    });
    let report = json(run_line("compare --json --photons 20000 {}", &[&fewer]).code(1));
    assert_eq!(counts(&report)[1..], [1, 0, 0]);
}

#[test]
fn hardly_a_match_is_never_certain() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let report = json(run_line("compare --json --seed 149 --photons 20000 {}", &[&csv]).code(1));
    assert_eq!(report["random_numbers"], "other");
    assert!(report["first_divergence"].is_null(), "{report}");
}

#[test]
fn the_header_names_the_reading() {
    let folder = folder();
    let line = "render --quiet --size 1x1 --photons 20000 --letter-of-the-handout --out {}";
    run_line(line, &[folder.path()]).success();
    let ply = folder.path().join("photons.ply");
    let csv = folder.path().join("csv");
    let other = reference_csv_in(&csv);
    let report = json(run_line("compare --json {} {}", &[&ply, &other]).code(0));
    assert_eq!(report["reading"], "t and b normalized");
}

fn reference_csv_in(folder: &Path) -> PathBuf {
    fs::create_dir_all(folder).expect("a folder");
    reference_csv(folder, 20_000)
}

#[test]
fn the_header_names_the_range_and_the_scene() {
    let folder = folder();
    let csv = reference_csv(folder.path(), 20_000);
    let part = folder.path().join("part");
    let line = "render --quiet --size 1x1 --photons 20000 --range 5000..9000 --out {}";
    run_line(line, &[&part]).success();
    let ply = part.join("photons.ply");
    let report = json(run_line("compare --json {} {}", &[&ply, &csv]).code(1));
    assert_eq!(report["outcome"], "different", "what is left out is not the same");
    assert_eq!(report["missing"], 0);
    assert!(report["note"].as_str().expect("a note").contains("only the photons 5000..9000"));

    let (model, light, _) = scaled_box(folder.path(), 2.0);
    let line = "compare --json --scene {} --light {} {} {}";
    let report = json(run_line(line, &[&model, Path::new(&light), &ply, &csv]));
    assert!(report["note"].as_str().expect("a note").contains("another scene"), "{report}");
}
