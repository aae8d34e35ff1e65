//! Draws a list that another program wrote: `render --photons-from`.

use std::path::Path;
use std::time::Instant;

use super::error::CliError;
use super::off_surfaces::OffSurfaces;
use super::other_format::{named, tell};
use super::progress;
use super::render::tally;
use super::run_summary::{Seconds, Summary};
use fast::dots::Dots;
use photon_list::reader;
use photon_list::record::Columns;
use photon_mapping::photon_list::ListHash;
use variants::run::Run;

/// Adds the photons of the list `path` to `dots`.
///
/// # Errors
/// When the list cannot be read.
pub fn read_list(
    is_quiet: bool,
    path: &Path,
    run: &Run,
    dots: &mut Dots,
) -> Result<Summary, CliError> {
    let start = Instant::now();
    let scene = run.scene();
    let surfaces = scene.mesh_objects().len();
    let mut hash = ListHash::default();
    let mut tally = tally(scene);
    let mut stored = 0;
    let mut off_surfaces = OffSurfaces::default();
    let progress = progress::bar(is_quiet, "list", 0);
    let read = reader::read(path, |record| {
        stored += 1;
        let position = run.placement.to_scene(record.position.as_dvec3());
        off_surfaces.add(scene, position);
        dots.add(scene, position);
        hash.update(&[record]);
        if usize::from(record.surface) < surfaces && (1..=1000).contains(&record.bounce) {
            tally.add(&record);
        }
        progress.inc(1);
    });
    progress.finish_and_clear();
    let (columns, note) = read.map_err(named)?;
    let off_surfaces = off_surfaces.most().map(|off| {
        format!(
            "{off} of {stored} photons lie on no surface of the scene: their axes or units may \
             differ from the scene's, which has z up and meters"
        )
    });
    tell(path, note);
    tell(path, off_surfaces);
    let (surfaces, total) = match columns.surface && columns.bounce {
        true => {
            let (surfaces, total) = tally.surfaces(stored, 1000, None);
            (surfaces, Some(total))
        }
        false => (Vec::new(), None),
    };
    Ok(Summary {
        stored,
        sha256: (columns == Columns::ALL).then(|| hash.hex()),
        seconds: Seconds { trace: start.elapsed().as_secs_f64(), ..Seconds::default() },
        surfaces,
        total,
        ..Summary::default()
    })
}
