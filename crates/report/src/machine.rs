//! Where the numbers come from: machine, versions, seeds, commands.

use std::fmt::Write as _;

use super::PageSection;
use super::plan::Plan;
use photon_mapping::assignment8;

/// The section of the page.
pub fn section(plan: &Plan) -> PageSection {
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    let seeds = |size, count| {
        let (first, last) = (Plan::seed(size, 0), Plan::seed(size, count - 1));
        format!("{first} to {last}")
    };
    let mut text = String::from("## 5. Machine, versions, seeds, commands\n\n| | |\n|---|---|\n");
    let mut row = |what: &str, value: &str| {
        let _ = writeln!(text, "| {what} | {value} |");
    };
    row("processor", &processor());
    row("cores used", &rayon::current_num_threads().to_string());
    row("cores there", &cores.to_string());
    row("system", &format!("{} {}", std::env::consts::OS, std::env::consts::ARCH));
    row("compiler", env!("RUSTC_VERSION"));
    row("built", if cfg!(debug_assertions) { "with debug assertions" } else { "optimized" });
    row("program", concat!("photon-mapping ", env!("CARGO_PKG_VERSION")));
    row("this report", &format!("`photon-mapping report{}`", plan.options));
    for (number, size) in plan.sizes.iter().enumerate() {
        row(&format!("seeds of section 1, {size} emitted"), &seeds(number, plan.seeds));
    }
    row("sections 2 and 3", &format!("seed {}", assignment8::SEED));
    for (number, size) in plan.sampler_sizes.iter().enumerate() {
        row(
            &format!("seeds of section 4, {size} emitted"),
            &seeds(100 + number, plan.sampler_seeds),
        );
    }
    row("one run again", "`photon-mapping render --seed S --photons N --json`");
    row("what is expected", "`photon-mapping expect --json`");
    text += "\nCounts and errors repeat to the last digit on any machine. Seconds do not, and \
             other work on the machine is in them. Compare ratios within one report.\n";
    PageSection { markdown: text, files: Vec::new() }
}

/// The processor's name, if the system gives one.
fn processor() -> String {
    let known = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = known.lines().find(|line| line.starts_with("model name"));
    let name = name.and_then(|line| line.split_once(':')).map(|(_, name)| name.trim());
    name.filter(|name| !name.is_empty()).unwrap_or("not known").to_owned()
}
