//! `photon-mapping explore`: the page that shows the photons in 3-D and steps through the port.

use std::io::Write as _;
use std::path::PathBuf;

use clap::Args;
use explore::comparison::{ListComparison, Other};
use explore::{Exploration, misreading};
use fast::lanes::picture::take_picture;
use fast::lanes::width::Width;
use oracle::summary::Tally;
use photon_list::reader::PhotonList;
use photon_mapping::assignment8::{self, HEIGHT, WIDTH};
use photon_mapping::rendering::photon_map::PhotonMap;

use super::beside_expected::beside_expected;
use super::error::{CliError, print};
use super::other_format::{load_list, tell};
use super::output::{self, OutputFile};
use super::run_args::RunArgs;
use super::values;

/// The name of the page.
pub const PAGE: &str = "explore.html";

/// The options of `explore`.
#[derive(Debug, Args)]
#[command(after_help = "The page is one file. Open it in a browser; it needs no network.")]
pub struct ExploreArgs {
    /// Open the page on this photon [default: the first that is stored]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
          value_parser = values::whole(0_u64, u64::MAX))]
    photon: Option<u64>,
    /// Show this photon list (PLY or CSV) over the reference's
    #[arg(long, value_name = "FILE", conflicts_with = "misreading")]
    submission: Option<PathBuf>,
    /// Show what this misreading stores over the reference's list, for example transposed-frame
    #[arg(long, value_name = "NAME", conflicts_with = "scene",
          value_parser = clap::builder::PossibleValuesParser::new(misreading::names()))]
    misreading: Option<String>,
    /// The folder for the page; created if it does not exist
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    #[command(flatten)]
    run: RunArgs,
}

/// Writes the page, and prints its path.
///
/// # Errors
/// When an input cannot be read or the page cannot be written.
pub fn run(arguments: &ExploreArgs) -> Result<u8, CliError> {
    let mut run = arguments.run.load()?;
    let emitted = run.renderer.emitted();
    if let Some(photon) = arguments.photon.filter(|photon| *photon >= emitted) {
        return Err(CliError::Argument(format!(
            "--photon {photon}: expected a number below {emitted}, the photons of the run"
        )));
    }
    let misreading = arguments.misreading.as_deref();
    let is_set = arguments.run.max_bounces.is_some();
    if misreading.is_some_and(misreading::needs_few_bounces) && !is_set {
        run.renderer.max_photon_bounces = misreading::FEW_BOUNCES;
    }
    let records = run.records(0..emitted);
    let mut tally = Tally::new(run.scene().mesh_objects().iter().map(|mesh| mesh.name.clone()));
    records.iter().for_each(|record| tally.add(record));
    let is_handout = arguments.run.scene.is_built_in();
    let (surfaces, total) = beside_expected(is_handout, &run, &(0..emitted), &tally);
    let other = match (&arguments.submission, misreading) {
        (Some(path), _) => {
            let name = path.file_name().unwrap_or(path.as_os_str());
            let name = name.to_string_lossy().into_owned();
            let (list, note) = load_list(path)?;
            tell(path, note);
            let recognize = || misreading::recognize(&list, &run);
            let misreading = is_handout.then(recognize).flatten();
            Some((Other::Submission { name, misreading }, list))
        }
        (None, Some(name)) => {
            let traced = misreading::trace(name, &run);
            traced.map(|(misreading, records)| {
                (Other::Misreading(misreading), PhotonList::of(records))
            })
        }
        (None, None) => None,
    };
    let reference = || PhotonList::of(records.clone());
    let comparison = other.map(|(other, list)| ListComparison::new(other, reference(), list, &run));

    let places = records.iter().map(|record| record.position.as_dvec3());
    run.renderer.diffuse_map = PhotonMap::new(places.map(|place| run.placement.to_scene(place)));
    let camera = run.placement.camera(assignment8::create_camera(WIDTH, HEIGHT));
    let picture = take_picture(&run.renderer, Width::widest(), &camera, WIDTH, HEIGHT, || ());
    let page = Exploration {
        run: &run,
        is_handout,
        records: &records,
        table: (&surfaces, &total),
        picture: &picture.picture,
        photon: arguments.photon,
        comparison: comparison.as_ref(),
    }
    .page();
    let mut file = OutputFile::create(&output::folder(&arguments.out)?.join(PAGE))?;
    let written = file.file().write_all(page.as_bytes());
    written.map_err(|error| CliError::unwritable(file.path(), error))?;
    let path = file.path().display().to_string();
    file.persist()?;
    print(&(path + "\n"))?;
    Ok(0)
}
