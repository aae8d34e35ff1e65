//! Checks the folders given as arguments.
use check::find::Submission;
use check::kit::Kit;
use check::{Settings, check};

fn main() {
    let kit = Kit::new(None).unwrap();
    for path in std::env::args_os().skip(1) {
        let submission = Submission::find(path.as_ref()).unwrap();
        match check(&submission, &kit, &Settings { jobs: 2, ..Settings::default() }) {
            Ok(report) => {
                print!("{}", check::text::text(&report));
                println!("  {:?}", report.seconds);
            }
            Err(error) => println!("{error}"),
        }
    }
}
