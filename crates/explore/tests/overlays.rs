//! Other lists laid over the run's: misreadings, submissions, and names that mean harm.

use std::sync::OnceLock;

use crate::browser::{Browser, launch};
use crate::support::{Traced, float, write_page};
use compare::explain::explain;
use compare::numbers::thousands;
use explore::Exploration;
use explore::comparison::Other;
use explore::misreading;
use oracle::table::ExpectedTable;
use photon_list::reader::PhotonList;
use photon_list::record::Columns;
use photon_mapping::assignment8;
use photon_mapping::photon_list::PhotonRecord;
use serde_json::{Value, json};
use variants::run::Run;
use variants::section::Section;

const PHOTONS: u64 = 20_000;
const POSITIONS_ALONE: Columns =
    Columns { intensity: false, to_light: false, photon: false, bounce: false, surface: false };

/// The run beside which `misreading` shows.
fn reference(misreading: &str) -> &'static Traced {
    static RUNS: [OnceLock<Traced>; 2] = [OnceLock::new(), OnceLock::new()];
    let is_short = misreading::needs_few_bounces(misreading);
    RUNS[usize::from(is_short)].get_or_init(|| {
        let mut run = Run::handout(assignment8::SEED, PHOTONS);
        if is_short {
            run.renderer.max_photon_bounces = misreading::FEW_BOUNCES;
        }
        Traced::of(run, Some(&ExpectedTable::of_assignment8()))
    })
}

fn submission(name: &str) -> Other {
    Other::Submission { name: name.to_owned(), misreading: None }
}

#[test]
fn every_misreading_opens_where_it_differs() {
    // No pixels are looked at, and without WebGL a page takes half the time.
    let Some(browser) = launch(false) else { return };
    let names = misreading::names();
    assert_eq!(names.len(), variants::misreadings::names().len());
    for name in names {
        let reference = reference(name);
        let (misreading, records) =
            misreading::trace(name, &reference.run).expect("it is in the table");
        let section = misreading.section;
        let title = section.title();
        let list = PhotonList::of(records.clone());
        let comparison = reference.beside(Other::Misreading(misreading), list);
        let page = write_page(name, &reference.exploration(Some(&comparison)).page());
        browser.load(&page, "");
        let text = |id: &str| browser.text_of(&format!("#{id}"));
        assert_eq!(text("verdict"), format!("{name}: {title}"));
        assert_eq!(text("step-title"), title, "{name}");
        assert_eq!(browser.run("document.getElementById('sides').hidden"), false, "{name}");
        // The photon that is open stores something else in the two lists, and the step is the one
        // that makes the first difference.
        let photon = float(&browser.run("page.photon")) as u32;
        let of = |list: &[PhotonRecord]| -> Vec<_> {
            let of_photon = list.iter().filter(|record| record.photon == photon);
            of_photon.map(|record| record.position).collect()
        };
        let (ours, theirs) = (of(&reference.records), of(&records));
        let pairs = ours.iter().zip(&theirs);
        let same = pairs.take_while(|(a, b)| a.distance(**b) < 1e-3).count();
        assert!(same < ours.len().max(theirs.len()), "{name}: photon {photon}");
        let expected = match section {
            Section::PhotonEmission => 0,
            Section::PhotonStorage if ["direct-stored", "direct-only"].contains(&name) => 0,
            // The second record is of the same bounce.
            Section::PhotonStorage if name == "stored-twice" => same,
            Section::PhotonStorage => same + 1,
            _ => same,
        };
        assert_eq!(browser.run("page.steps[page.at].bounce"), expected, "{name}: photon {photon}");
        // The code is in sight under the verdict and both values, and so is the box between lines.
        // Without WebGL, the page says so above them.
        browser.run("document.getElementById('trouble').hidden = true");
        let [_, top, ..] = browser.edges("#code .lit");
        assert!(top < 780.0, "{name}: {top}");
        let lines = float(&browser.run("(page.view.layers.moved?.count ?? 0) / 2"));
        assert!(lines < 200.0, "{name}: {lines}");
        // What is counted is what is drawn.
        let kinds = browser.run(
            "[0, 1, 2, 3].map((kind) => page.run.dotKind.reduce((n, k) => n + (k === kind), 0))",
        );
        let legend = browser.run("page.run.comparison.legend");
        for (kind, what) in ["matched", "missing"].into_iter().enumerate() {
            let drawn = thousands(float(&kinds[kind]) as u64);
            assert_eq!(legend[kind], format!("{drawn} {what}"), "{name}");
        }
        // A list whose records tell their photon opens it from there, as a whole of the story.
        let story = explain(&reference.run, photon.into()).expect("emitted");
        let chips = browser.run("document.querySelectorAll('#path a').length");
        assert!(float(&chips) >= story.hits.len() as f64, "{name}");
    }
    browser.has_been_quiet();
}

#[test]
fn a_submission_shows_where_it_parts() {
    let Some(browser) = launch(true) else { return };
    let reference = reference("");
    // One photon moved, one missing, one extra, in a list that tells only positions.
    let mut list = reference.list();
    list.columns = POSITIONS_ALONE;
    list.records[10].position.x += 0.2;
    list.records.remove(500);
    let mut extra = list.records[900];
    extra.position.z += 0.5;
    (extra.photon, extra.bounce, extra.surface) = (u32::MAX, u16::MAX, u16::MAX);
    list.records.insert(900, extra);
    let comparison = reference.beside(submission("mine.csv"), list);
    let page = write_page("positions", &reference.exploration(Some(&comparison)).page());
    browser.open(&page, "");
    let all = reference.records.len() as u64;
    let legend = format!(" {} matched 1 missing 1 moved 1 extra", thousands(all - 2));
    let told = browser.text(
        "[...document.querySelectorAll('#legend li')].map((entry) => \
         entry.lastChild.textContent).join('')",
    );
    assert_eq!(told, legend);
    assert_eq!(float(&browser.run("page.photon")) as u32, reference.records[10].photon);
    assert!(browser.text_of("#sides").contains("submission"));
    // The line leads from where the photon is to where it should be.
    assert_eq!(browser.run("page.view.layers.moved.count / 2"), 1);
    // So few dots that differ are large: the one that moved at both of its places.
    assert_eq!(browser.run("page.looks.filter((look, i) => i % 2 && look === 3).length"), 4);
    // A dot of a list without numbers is shown, too, and the one that moved counts once.
    let shown = browser.text_of("#shown");
    assert_eq!(shown.replace(',', ""), format!("{} photons shown.", all + 1));
    // All that moved in a cell have their line as long as the cell is lit.
    let moved = &reference.records[10];
    let [row, column] = [moved.surface + 1, moved.bounce.min(4) + 1];
    let alpha = || {
        let tenths = "Math.round(page.view.layers.moved.columns[1][3] / 25.5)";
        float(&browser.run(tenths))
    };
    browser.press("n");
    browser.run(&format!(
        "document.querySelector('#table tbody tr:nth-child({row}) td:nth-child({column}) \
         button').focus()"
    ));
    assert_eq!(browser.run("page.view.layers.moved.count / 2"), 1);
    assert_eq!(alpha(), 7.0);
    browser.run("document.activeElement.blur()");
    assert_eq!(alpha(), 10.0);
    // Elsewhere, and back by the button.
    browser.press("n");
    browser.click_on("#divergence");
    browser.wait_for(&format!("page.photon === {}", reference.records[10].photon));
    // On a phone the head is folded, and a key unfolds it.
    assert_eq!(browser.run("document.getElementById('comparison').open"), true);
    browser.size(390, 844);
    browser.open(&page, "");
    assert_eq!(browser.run("document.getElementById('comparison').open"), false);
    let [_, top, ..] = browser.edges("#stage");
    assert!(top < 130.0, "{top}");
    browser.run("document.querySelector('#comparison summary').focus()");
    browser.press("Enter");
    assert_eq!(browser.run("document.getElementById('reason').checkVisibility()"), true);
    assert_eq!(browser.run("document.documentElement.scrollWidth"), 390);
    browser.size(1280, 800);
    browser.has_been_quiet();

    let same = reference.beside(submission("same.csv"), reference.list());
    let page = write_page("same", &reference.exploration(Some(&same)).page());
    browser.open(&page, "");
    assert_eq!(browser.text_of("#verdict"), "same.csv: identical");
    assert_eq!(browser.run("document.getElementById('divergence').hidden"), true);
    assert_eq!(browser.text("document.getElementById('comparison').className"), "same");
    browser.has_been_quiet();
}

/// The counts that the table shows of the submission, row by row.
fn counts_of_submission(browser: &Browser) -> Value {
    browser.run(
        "[...document.querySelectorAll('#table tbody tr')].map((row) => \
         [...row.querySelectorAll('button')].map((cell) => \
         cell.querySelector('.extra')?.textContent.replace(',', '') ?? null))",
    )
}

#[test]
fn a_fair_list_of_another_seed_is_said_to_have_other_numbers() {
    let Some(browser) = launch(false) else { return };
    let reference = reference("");
    let other = Traced::of(Run::handout(2, PHOTONS), None);
    for tells in [true, false] {
        let mut list = other.list();
        if !tells {
            list.columns = POSITIONS_ALONE;
            list.records.iter_mut().for_each(|record| {
                (record.photon, record.bounce, record.surface) = (u32::MAX, u16::MAX, u16::MAX);
            });
        }
        let comparison = reference.beside(submission("mine.csv"), list);
        let page = write_page("seed", &reference.exploration(Some(&comparison)).page());
        browser.open(&page, "");
        let text = |id: &str| browser.text_of(&format!("#{id}"));
        // A list without numbers may be one of the same numbers that is all wrong.
        let doubt = if tells { "" } else { " (perhaps)" };
        assert_eq!(text("verdict"), format!("mine.csv: other random numbers{doubt}"));
        // Where two photons of other numbers part tells nothing, and neither does what is matched.
        assert_eq!(browser.run("document.getElementById('divergence').hidden"), true);
        assert_eq!(browser.run("document.getElementById('sides').hidden"), true);
        assert_eq!(browser.run("page.run.movedIndex.length === 0"), tells);
        assert!(text("reason").contains("random numbers"), "{}", text("reason"));
        assert!(text("advice").contains("photon-mapping grade"), "{}", text("advice"));
        assert!(text("advice").contains("--photons"), "{}", text("advice"));
        let of_two_lists = json!(["matched", "reference", "moved", "submission"]);
        assert_eq!(browser.run("page.run.comparison.legend") == of_two_lists, tells);
        assert_eq!(browser.text("document.getElementById('comparison').className"), "unknown");
        // What the list tells is counted, and nothing else.
        let (surfaces, total) = &other.table;
        let rows: Vec<Vec<Option<String>>> = surfaces
            .iter()
            .chain([total])
            .map(|row| {
                let cells = row.by_bounce.iter().take(3).chain([&row.late]);
                let counts = cells.map(|cell| cell.stored).chain([row.stored]);
                counts.map(|count| tells.then(|| count.to_string())).collect()
            })
            .collect();
        let mut rows = json!(rows);
        rows[surfaces.len()][4] = json!(total.stored.to_string());
        assert_eq!(counts_of_submission(&browser), rows);
    }
    browser.has_been_quiet();
}

#[test]
fn without_webgl_it_is_told_whose_picture_is_shown() {
    let Some(browser) = launch(false) else { return };
    let reference = reference("");
    let same = reference.beside(submission("a"), reference.list());
    browser.open(&write_page("flat", &reference.exploration(Some(&same)).page()), "");
    let told = browser.text_of("#trouble");
    assert!(told.contains("the reference's picture"), "{told}");
}

#[test]
fn hostile_names_stay_names() {
    let Some(browser) = launch(true) else { return };
    let reference = reference("");
    let name = "</script><script>window.hurt = 1</script></title><script>hurt = 1</script><img \
                src=x onerror='hurt=1'>{data}{script}\u{2028}.csv";
    let (mut surfaces, total) = reference.table.clone();
    surfaces[0].name = name.to_owned();
    let mut list = reference.list();
    list.records[10].position.x += 0.2;
    let comparison = reference.beside(submission(name), list);
    let exploration = reference.exploration(Some(&comparison));
    let page = Exploration { table: (&surfaces, &total), ..exploration }.page();
    let page = write_page("hostile", &page);
    browser.open(&page, "");
    assert_eq!(browser.run("window.hurt"), json!(null));
    assert!(browser.text("document.title").starts_with(name));
    assert!(browser.text_of("#verdict").starts_with(name));
    assert_eq!(browser.text_of("#table tbody th"), name);
    assert_eq!(browser.run("document.querySelectorAll('script').length"), 3);
    // Should anything get through all the same, the policy keeps it from running.
    browser.run(
        "document.body.append(Object.assign(document.createElement('script'), { textContent: \
         'window.hurt = 2' }))",
    );
    assert_eq!(browser.run("window.hurt"), json!(null));
}

#[test]
fn a_submission_that_shows_a_misreading_is_told_so() {
    // Each trial traces the whole table, so not all are tried; half do not tell their photons.
    let some = misreading::names().into_iter().filter(|name| *name != "repeated-paths").step_by(4);
    for (name, tells_photons) in some.chain(["third-hit-on"]).zip([true, false].into_iter().cycle())
    {
        let reference = reference(name);
        let (_, records) = misreading::trace(name, &reference.run).expect("it is in the table");
        let mut list = PhotonList::of(records);
        list.columns.photon = tells_photons;
        let misreading = misreading::recognize(&list, &reference.run).expect(name);
        assert_eq!(misreading.id, name);
        let expected = format!(">mine.csv: {}</h2>", misreading.section.title());
        let mine = Other::Submission { name: "mine.csv".into(), misreading: Some(misreading) };
        let comparison = reference.beside(mine, list);
        let page = reference.exploration(Some(&comparison)).page();
        assert!(page.contains(&expected), "{name}: {expected}");
        assert!(page.contains(&format!("This is the misreading {name}.")));
    }
    // The reference itself shows none, nor does a list that breaks off or has other numbers.
    let reference = reference("");
    let shows = |list: &PhotonList| misreading::recognize(list, &reference.run).map(|it| it.id);
    let mut list = reference.list();
    assert_eq!(shows(&list), None);
    list.records.truncate(500);
    assert_eq!(shows(&list), None);
    let other = Traced::of(Run::handout(1, PHOTONS), None);
    assert_eq!(shows(&other.list()), None);
}
