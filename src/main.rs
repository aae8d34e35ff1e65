//! The assignment, run straight through: photons, picture, list, and a table of what was stored.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use photon_mapping::assignment8::{HEIGHT, WIDTH, create_camera, create_renderer, create_scene};
use photon_mapping::photon_list::{ListHash, PhotonRecord, ply_header, records, write_rows};
use photon_mapping::rendering::image_writer::take_picture;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;

/// Photons stored per emitted photon, by surface and bounce, computed without tracing.
const EXPECTED: &str = include_str!("../golden/expected.csv");
/// Photons that bounced as often as this or more share the last column.
const LAST_COLUMN: usize = 4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = create_scene();
    let mut renderer = create_renderer(scene.clone());
    let mut list = Vec::new();
    renderer.initialize_renderer(|photon, path, stored| {
        list.extend(records(&scene, photon, path, stored));
    });
    let picture = take_picture(&renderer, &create_camera(WIDTH, HEIGHT), WIDTH, HEIGHT);

    let out = Path::new("out");
    fs::create_dir_all(out)?;
    let picture_path = out.join("assignment8.png");
    picture.save(&picture_path)?;
    let list_path = out.join("photons.ply");
    write_list(&list_path, &renderer, &list)?;

    let mut hash = ListHash::default();
    hash.update(&list);
    let (seed, emitted) = (renderer.seed, renderer.emitted());
    println!("seed {seed}: {emitted} photons emitted, {} stored\n", list.len());
    println!("{}", table(&renderer, &list));
    println!("photon list SHA-256 {}", hash.hex());
    println!("written: {}, {}", picture_path.display(), list_path.display());
    println!("\nTo compare, explain and grade, use the toolkit: photon-mapping --help");
    Ok(())
}

fn write_list(
    path: &Path,
    renderer: &PhotonMappingRenderer,
    list: &[PhotonRecord],
) -> io::Result<()> {
    let PhotonMappingRenderer { seed, max_photon_bounces, .. } = renderer;
    let emitted = renderer.emitted();
    let mut comments = vec![
        format!("photon-mapping {}", env!("CARGO_PKG_VERSION")),
        format!("seed {seed} emitted {emitted} max_bounces {max_photon_bounces}"),
    ];
    let mesh_objects = renderer.stored_scene.mesh_objects().iter().enumerate();
    comments.extend(mesh_objects.map(|(index, mesh)| format!("surface {index} {}", mesh.name)));
    let mut file = BufWriter::new(File::create(path)?);
    file.write_all(ply_header(list.len() as u64, &comments).as_bytes())?;
    write_rows(&mut file, list)?;
    file.flush()
}

/// Stored and expected photons, a line for every surface and one for all of them.
fn table(renderer: &PhotonMappingRenderer, list: &[PhotonRecord]) -> String {
    let mut lines = EXPECTED.lines();
    let heads = lines.next().unwrap_or_default().replace(',', " ");
    let mut text = format!("stored / expected\n{:10}", "surface");
    for head in heads.split(" bounce").skip(1).map(|bounce| format!("bounce{bounce}")) {
        text += &format!("{head:>18}");
    }
    text += &format!("{:>18}\n", "stored");
    let mut total = [(0, 0.0); LAST_COLUMN + 1];
    for (surface, line) in lines.enumerate() {
        let mut cells = [(0, 0.0); LAST_COLUMN + 1];
        for record in list.iter().filter(|record| usize::from(record.surface) == surface) {
            cells[usize::from(record.bounce).min(LAST_COLUMN) - 1].0 += 1;
        }
        for (cell, expected) in cells.iter_mut().zip(line.split(',').skip(1)) {
            let per_photon: f64 = expected.parse().expect("the table has numbers");
            cell.1 = per_photon * renderer.emitted() as f64;
        }
        cells[LAST_COLUMN] = sum(&cells[..LAST_COLUMN]);
        for (total, cell) in total.iter_mut().zip(&cells) {
            *total = sum(&[*total, *cell]);
        }
        text += &row(&renderer.stored_scene.mesh_objects()[surface].name, &cells);
    }
    text + &row("total", &total)
}

fn sum(cells: &[(u64, f64)]) -> (u64, f64) {
    cells.iter().fold((0, 0.0), |sum, cell| (sum.0 + cell.0, sum.1 + cell.1))
}

fn row(name: &str, cells: &[(u64, f64)]) -> String {
    let cells = cells
        .iter()
        .map(|(stored, expected)| format!("{:>18}", format!("{stored} / {expected:.1}")));
    format!("{name:10}{}\n", cells.collect::<String>())
}
