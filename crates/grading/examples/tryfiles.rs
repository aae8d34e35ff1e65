use grading::judge_list::{Expectations, judge};
use grading::observation::observe;
use grading::places::Places;
use grading::signature::Signatures;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
fn main() {
    let e = Expectations::new(
        Places::new(&create_scene()),
        Signatures::of_kept(
            1000,
            serde_json::from_str(
                &std::fs::read_to_string("golden/signatures-of-lists.json").unwrap(),
            )
            .unwrap(),
        ),
    );
    let light = create_scene().lights()[0].position.as_dvec3();
    for file in std::env::args().skip(1) {
        let (mut list, _) =
            photon_list::reader::load_at_most(std::path::Path::new(&file), 5_000_000).unwrap();
        grading::axes::turn_to_world(&mut list, &e.places);
        let emitted = if file.contains("cull_front") { 1e6 } else { 2e5 };
        let short = file.rsplit('/').next().unwrap().to_owned();
        for mode in ["pos", "num", "all"] {
            let mut list = list.clone();
            if mode == "all" && list.columns == Columns::default() {
                continue;
            }
            if mode != "all" {
                list.columns = Columns::default();
                list.records
                    .iter_mut()
                    .for_each(|r| *r = PhotonRecord { position: r.position, ..ABSENT });
            }
            let o = observe(&list, &e.places, light);
            let by_user = (mode == "num").then_some(emitted);
            let j = judge(&o, by_user.or(o.emitted_by_intensity), by_user.is_some(), &e);
            let faults: Vec<_> = j.findings.iter().filter(|f| f.is_fault()).collect();
            let name = j.explanation.as_ref().map(|x| {
                format!("{} {:.3} p={:.2e}", x.hypothesis.id, x.confidence, x.fit.p_value)
            });
            let pair = j.pair.as_ref().map(|x| x.hypothesis.title.clone());
            let grave = faults.iter().any(|f| f.weight == grading::verdict::Weight::Grave);
            println!(
                "{short:32} {mode}: {} {} name={name:?} pair={pair:?} {:?}",
                if faults.is_empty() { "CORRECT" } else { "incorrect" },
                if grave { "GRAVE" } else { "" },
                faults.iter().map(|f| f.check).collect::<Vec<_>>()
            );
            if std::env::var("ADVICE").is_ok() {
                let mut seen = std::collections::BTreeSet::new();
                for f in &faults {
                    if seen.insert(f.advice.clone()) {
                        println!("      [{}] {}: {}", f.check, f.found, f.advice);
                    }
                }
            }
        }
    }
}
