//! `photon-mapping render`: trace the photons, write their list, draw the picture.

use std::io;
use std::ops::Range;
use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};

use super::beside_expected::beside_expected;
use super::error::CliError;
use super::output::{self, OutputFile};
use super::progress;
use super::read_list::read_list;
use super::run_args::RunArgs;
use super::run_summary::{Seconds, Summary, print_summary};
use super::values;
use fast::dots::Dots;
use fast::lanes::picture::{CheckedPicture, take_picture};
use fast::lanes::width::Width;
use fast::trace::FirstDifference;
use oracle::summary::Tally;
use photon_list::writer::{Format, ListWriter};
use photon_mapping::assignment8;
use photon_mapping::photon_list::ListHash;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::scene::Scene;
use variants::run::Run;
use variants::sampler::Sampler;

/// The options of `render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    run: RunArgs,
    /// Trace only a part of the run: 0..500000 are the photons 0 to 499999. 'merge' joins the parts
    /// [default: all]
    #[arg(long, value_name = "A..B", value_parser = values::range)]
    range: Option<Range<u64>>,
    /// How many threads to use; the list does not depend on it [default: one for each core]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
          value_parser = values::whole(1_u16, 1024))]
    threads: Option<u16>,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = values::size)]
    size: (u32, u32),
    /// The folder for the picture and the list; created if it does not exist
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Trace nothing: draw the dots of this list, PLY or CSV, with at least the columns x, y and z
    #[arg(long, value_name = "FILE",
          conflicts_with_all = ["seed", "photons", "max_bounces", "range", "format",
                                "letter_of_the_handout", "sampler"])]
    photons_from: Option<PathBuf>,
    /// The format of the list
    #[arg(long, value_enum, default_value_t = ListFormat::Ply)]
    format: ListFormat,
    /// Write no list and draw no picture: only count. Memory does not grow with the number of
    /// photons; `merge` adds up the JSON summaries of adjoining ranges
    #[arg(long, conflicts_with_all = ["photons_from", "format", "size", "out"])]
    count_only: bool,
    /// Where the random numbers come from. Keep chacha to compare lists with the reference; sobol
    /// gives other photons, whose counts are closer to the expected values
    #[arg(long, value_enum, default_value_t = SamplerName::Chacha)]
    sampler: SamplerName,
    /// No progress bars
    #[arg(long, short)]
    quiet: bool,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

/// The names of the list formats.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum ListFormat {
    /// Binary PLY, for MeshLab, CloudCompare and Blender
    Ply,
    /// Comma-separated values, for everything else
    Csv,
}

/// The names of the samplers.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum SamplerName {
    /// A ChaCha stream for every photon: the reference
    Chacha,
    /// An Owen-scrambled Sobol sequence: other photons, whose counts are closer to what is expected
    Sobol,
}

/// Renders, and prints the summary.
///
/// # Errors
/// When an input cannot be read or an output cannot be written.
pub fn run(arguments: &RenderArgs) -> Result<u8, CliError> {
    let threads = arguments.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| CliError::Argument(format!("--threads: {error}")))?;
    let summary = pool.install(|| render(arguments))?;
    print_summary(&summary, arguments.json)
}

fn render(arguments: &RenderArgs) -> Result<Summary, CliError> {
    let mut run = arguments.run.load()?;
    run.sampler = match arguments.sampler {
        SamplerName::Chacha => Sampler::ChaCha,
        SamplerName::Sobol => Sampler::Sobol,
    };
    if arguments.count_only {
        return count(arguments, &run);
    }
    let photons = match arguments.photons_from {
        Some(_) => 0..0,
        None => photons(arguments, &run)?,
    };
    let mut picture_file =
        OutputFile::create(&output::folder(&arguments.out)?.join("assignment8.png"))?;
    let (width, height) = arguments.size;
    let camera = run.placement.camera(assignment8::create_camera(width, height));
    let mut dots = Dots::new(camera, width, height);
    let (mut summary, list_file) = match &arguments.photons_from {
        Some(path) => (read_list(arguments.quiet, path, &run, &mut dots)?, None),
        None => {
            let (summary, file) = trace(arguments, &run, photons, &mut dots)?;
            (summary, Some(file))
        }
    };

    let start = Instant::now();
    run.renderer.diffuse_map = dots.remaining();
    let progress = progress::bar(arguments.quiet, "picture", u64::from(height));
    let (lanes, row_done) = (Width::widest(), || progress.inc(1));
    let CheckedPicture { mut picture, difference } =
        take_picture(&run.renderer, lanes, &camera, width, height, row_done);
    summary
        .differences_from_port
        .extend(difference.map(|(column, row)| format!("the pixel in column {column}, row {row}")));
    dots.draw(&mut picture);
    progress.finish_and_clear();
    summary.seconds.picture = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let mut png = io::BufWriter::new(picture_file.file());
    // Trying every filter on every row takes five times as long, and saves a seventh of the file.
    let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Up);
    let written = picture.write_with_encoder(encoder);
    let flushed = written.map_err(io::Error::other).and_then(|()| io::Write::flush(&mut png));
    drop(png);
    flushed.map_err(|error| CliError::unwritable(picture_file.path(), error))?;
    for file in [Some(picture_file), list_file].into_iter().flatten() {
        summary.files.push(file.path().to_owned());
        file.persist()?;
    }
    summary.seconds.write += start.elapsed().as_secs_f64();
    Ok(summary)
}

/// The photons to trace.
fn photons(arguments: &RenderArgs, run: &Run) -> Result<Range<u64>, CliError> {
    let emitted = run.renderer.emitted();
    if emitted == 0 {
        return Err(CliError::Argument(
            "--photons: expected enough photons for every light to get one, none is emitted"
                .to_owned(),
        ));
    }
    let photons = arguments.range.clone().unwrap_or(0..emitted);
    if photons.end > emitted {
        let Range { start, end } = photons;
        return Err(CliError::Argument(format!(
            "--range {start}..{end}: expected an end of at most {emitted}, the photons of the run"
        )));
    }
    Ok(photons)
}

/// Traces the photons and keeps nothing but their counts.
fn count(arguments: &RenderArgs, run: &Run) -> Result<Summary, CliError> {
    let start = Instant::now();
    let photons = photons(arguments, run)?;
    let mut hash = ListHash::default();
    let mut tally = tally(run.scene());
    let progress = progress::bar(arguments.quiet, "photons", photons.end - photons.start);
    let difference = run.trace_list(photons.clone(), |records: &[PhotonRecord], done| {
        hash.update(records);
        records.iter().for_each(|record| tally.add(record));
        progress.set_position(done);
        Ok::<(), CliError>(())
    })?;
    progress.finish_and_clear();
    let counts = Some(tally.counts());
    let part = Some(run.part(photons.clone()));
    let traced = traced(arguments, run, &photons, &tally, &hash, start);
    Ok(Summary { counts, run: part, differences_from_port: of_list(difference), ..traced })
}

/// Traces the list into a file that is not yet in its place, and adds its photons to `dots`.
fn trace(
    arguments: &RenderArgs,
    run: &Run,
    photons: Range<u64>,
    dots: &mut Dots,
) -> Result<(Summary, OutputFile), CliError> {
    let start = Instant::now();
    let (name, format) = match arguments.format {
        ListFormat::Ply => ("photons.ply", Format::Ply),
        ListFormat::Csv => ("photons.csv", Format::Csv),
    };
    let mut file = OutputFile::create(&arguments.out.join(name))?;
    let path = file.path().to_owned();
    let unwritable = |error| CliError::unwritable(&path, error);
    let mut hash = ListHash::default();
    let mut tally = tally(run.scene());
    let scene = run.scene();
    let progress = progress::bar(arguments.quiet, "photons", photons.end - photons.start);
    let mut writer =
        ListWriter::new(file.file(), format, comments(run, &photons)).map_err(unwritable)?;
    let traced_list = run.trace_list(photons.clone(), |records: &[PhotonRecord], done| {
        hash.update(records);
        records.iter().for_each(|record| tally.add(record));
        for record in records {
            dots.add(scene, run.placement.to_scene(record.position.as_dvec3()));
        }
        progress.set_position(done);
        writer.write(records)
    });
    let difference = traced_list.map_err(unwritable)?;
    writer.finish().map_err(unwritable)?;
    progress.finish_and_clear();
    let summary = traced(arguments, run, &photons, &tally, &hash, start);
    Ok((Summary { differences_from_port: of_list(difference), ..summary }, file))
}

fn of_list(difference: Option<FirstDifference>) -> Vec<String> {
    difference.iter().map(FirstDifference::to_string).collect()
}

/// What tracing `photons` since `start` came to.
fn traced(
    arguments: &RenderArgs,
    run: &Run,
    photons: &Range<u64>,
    tally: &Tally,
    hash: &ListHash,
    start: Instant,
) -> Summary {
    let seconds = Seconds { trace: start.elapsed().as_secs_f64(), ..Seconds::default() };
    let is_built_in = arguments.run.scene.is_built_in();
    let (surfaces, total) = beside_expected(is_built_in, run, photons, tally);
    Summary {
        seed: Some(run.renderer.seed),
        sampler: other_sampler(run),
        emitted: Some(photons.end - photons.start),
        stored: tally.stored(),
        sha256: Some(hash.hex()),
        seconds,
        surfaces,
        total: Some(total),
        ..Summary::default()
    }
}

/// Counts by surface and bounce, for the surfaces of `scene`.
pub fn tally(scene: &Scene) -> Tally {
    Tally::new(scene.mesh_objects().iter().map(|mesh_object| mesh_object.name.clone()))
}

/// The sampler's name where it is not the reference's.
fn other_sampler(run: &Run) -> Option<&'static str> {
    (run.sampler != Sampler::ChaCha).then(|| run.sampler.name())
}

/// What the header of a PLY list says of the run.
fn comments(run: &Run, photons: &Range<u64>) -> Vec<String> {
    let mut comments = run.part(photons.clone()).comments();
    comments.extend(other_sampler(run).map(|name| format!("sampler {name}")));
    let mesh_objects = run.scene().mesh_objects().iter().enumerate();
    comments.extend(mesh_objects.map(|(index, mesh)| format!("surface {index} {}", mesh.name)));
    comments
}
