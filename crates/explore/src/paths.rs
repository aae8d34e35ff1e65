//! A run as the page's columns: its paths, what each stored, and the numbers of each story.

use std::collections::BTreeSet;

use compare::explain::{Ending, Story, explain};
use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::PHOTON_DOT_RADIUS;
use photon_mapping::scene::numerics::LARGE_EPSILON;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::Value;
use variants::run::Run;

use super::Exploration;
use super::comparison::ListComparison;
use super::overlay::Overlay;
use super::pack::PackedColumns;
use super::scene::{PageFace, PageSurface, cameras, edges, faces, surfaces};

/// A page shows all stored photons up to so many; of more, an evenly thinned sample of whole paths.
const MOST_STORED: usize = 1_000_000;
/// So many photons that only a submission stores get a story of the reference, evenly thinned.
const MOST_STORIES_OF_OTHERS: usize = 20_000;

/// What the page reads of a run.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Paths {
    /// The packed numbers.
    #[serde(skip)]
    pub columns: PackedColumns,
    /// How many stored photons the page has, if it leaves out some.
    #[serde(skip)]
    pub thinned: Option<u64>,
    /// The photon, bounce and step on which the page opens.
    start: Option<(u64, usize, &'static str)>,
    surfaces: Vec<PageSurface>,
    faces: Vec<PageFace>,
    lights: Vec<[f32; 3]>,
    camera: Value,
    /// That with which the page opens.
    first_camera: Value,
    picture_camera: Value,
    /// The scene's longest edge, in world units.
    size: f32,
    /// The edge of the cube in which the picture looks for a photon, in world units.
    dot_size: f32,
    /// How far along the normal each scattered ray starts, where that is the same for all.
    offset: Option<f32>,
}

impl Paths {
    /// The run of `exploration`.
    pub fn new(exploration: &Exploration) -> Self {
        let run = exploration.run;
        let (scene, placement) = (run.scene(), &run.placement);
        let (surfaces, faces) = (surfaces(scene), faces(run));
        let thinned = thin(exploration.records, MOST_STORED);
        let records = thinned.as_deref().unwrap_or(exploration.records);
        let stories = stories(exploration, records);
        let mut columns = PackedColumns::default();
        add_walls(&mut columns, &surfaces, &faces);
        add_paths(&mut columns, &stories, &faces, run);
        add_dots(&mut columns, &stories, exploration);
        let first = records.first().map(|record| u64::from(record.photon));
        let size = run.size();
        let parting = exploration.comparison.and_then(ListComparison::parting);
        let lights = scene.lights().iter();
        let [camera, first_camera, picture_camera] = cameras(exploration.is_handout, &faces, size);
        Self {
            columns,
            thinned: thinned.as_ref().map(|kept| kept.len() as u64),
            start: parting.or_else(|| Some((exploration.photon.or(first)?, 0, "emission"))),
            surfaces,
            lights: lights.map(|light| placement.to_world(light.position).to_array()).collect(),
            camera,
            first_camera,
            picture_camera,
            faces,
            size,
            dot_size: placement.length_to_world(2.0 * PHOTON_DOT_RADIUS),
            offset: exploration.is_handout.then_some(LARGE_EPSILON),
        }
    }
}

/// Whole paths of `records`, evenly spread, that are at most about `most` records; nothing if all
/// are.
fn thin(records: &[PhotonRecord], most: usize) -> Option<Vec<PhotonRecord>> {
    if records.len() <= most {
        return None;
    }
    let part = most as f64 / records.len() as f64;
    let paths = records.chunk_by(|a, b| a.photon == b.photon);
    let kept = paths.enumerate().filter(|(i, _)| {
        let before = (*i as f64 * part) as usize;
        ((*i + 1) as f64 * part) as usize > before
    });
    Some(kept.flat_map(|(_, path)| path.iter().copied()).collect())
}

/// The stories of all paths of `records`, and of the photons that the page names besides, in order.
fn stories(exploration: &Exploration, records: &[PhotonRecord]) -> Vec<Story> {
    let mut photons: Vec<u64> = records.iter().map(|record| u64::from(record.photon)).collect();
    photons.dedup();
    let mut others: BTreeSet<u64> = exploration.photon.into_iter().collect();
    if let Some(comparison) = exploration.comparison {
        others.extend(comparison.parting().map(|(photon, ..)| photon));
        let extra = comparison.photons_of_extra();
        let step = extra.len() / MOST_STORIES_OF_OTHERS + 1;
        others.extend(extra.into_iter().step_by(step));
    }
    photons.extend(others);
    photons.par_sort_unstable();
    photons.dedup();
    let stories = photons.par_iter().filter_map(|photon| explain(exploration.run, *photon));
    stories.collect()
}

/// For each record of `records`, its place among the photons that `stories` store, or nothing.
fn stored_places(stories: &[Story], records: &[PhotonRecord]) -> Vec<Option<u32>> {
    let mut stored = stories
        .iter()
        .flat_map(|story| story.hits.iter().skip(1).map(|hit| (story.photon, hit.bounce)))
        .zip(0_u32..)
        .peekable();
    let places = records.iter().map(|record| {
        let key = (u64::from(record.photon), usize::from(record.bounce));
        while stored.next_if(|(other, _)| *other < key).is_some() {}
        stored.next_if(|(other, _)| *other == key).map(|(_, place)| place)
    });
    places.collect()
}

/// Adds the triangles of the walls, and the outlines of the faces.
fn add_walls(columns: &mut PackedColumns, surfaces: &[PageSurface], faces: &[PageFace]) {
    let corners = || {
        faces.iter().flat_map(|face| {
            face.triangles.as_flattened().iter().map(move |corner| (face, *corner))
        })
    };
    columns.vectors("wallPosition", &corners().map(|(_, corner)| corner).collect::<Vec<_>>());
    columns.normals("wallNormal", &corners().map(|(face, _)| face.normal).collect::<Vec<_>>());
    let colors = corners().flat_map(|(face, _)| {
        let [r, g, b] = surfaces[face.surface].diffuse_response.map(|x| (x * 255.0) as u8);
        [r, g, b, 255]
    });
    columns.bytes("wallColor", &colors.collect::<Vec<_>>());
    columns.vectors("edgeEnds", edges(faces).as_flattened());
}

fn add_paths(columns: &mut PackedColumns, stories: &[Story], faces: &[PageFace], run: &Run) {
    let hits = || stories.iter().flat_map(|story| &story.hits);
    let mut before = 0;
    let steps: Vec<u32> = stories
        .iter()
        .map(|story| {
            let step = story.photon - before;
            before = story.photon;
            u32::try_from(step).expect("a run has fewer than 2^32 photons")
        })
        .collect();
    columns.words("pathPhoton", &steps);
    let short = |count: usize| u16::try_from(count).expect("a scene has fewer than 2^16 of them");
    let counts: Vec<u16> = stories.iter().map(|story| short(story.hits.len())).collect();
    columns.shorts("pathHits", &counts);
    let endings: Vec<u8> = stories
        .iter()
        .map(|story| match story.ending {
            Ending::Absorbed => 0,
            Ending::LeftTheScene => 1,
            Ending::BounceLimit => 2,
        })
        .collect();
    columns.bytes("pathEnding", &endings);
    let lights: Vec<u16> = stories.iter().map(|story| short(story.emission.light)).collect();
    columns.shorts("pathLight", &lights);
    let face_of = |surface: usize, facet: usize| {
        let key = (surface, facet);
        let face = faces.binary_search_by_key(&key, |face| (face.surface, face.facet));
        short(face.expect("a hit lies on a face of the scene"))
    };
    let of_hits: Vec<u16> = hits().map(|hit| face_of(hit.surface_index, hit.facet)).collect();
    columns.shorts("hitFace", &of_hits);
    columns.floats("hitT", &hits().map(|hit| hit.t).collect::<Vec<_>>());
    let scattered: Vec<_> = hits().filter_map(|hit| hit.direction).collect();
    columns.vectors("scattered", &scattered);
    // What the page can compute to the same bits, by one line each, is left out.
    if !stories.iter().all(emission_follows) {
        let directions: Vec<_> = stories.iter().map(|story| story.emission.direction).collect();
        columns.vectors("emission", &directions);
    }
    if !stories.iter().all(|story| direct_follows(story, run)) {
        let direct = |story: &Story| story.hits.first().map_or([0.0; 3], |hit| hit.position);
        columns.vectors("direct", &stories.iter().map(direct).collect::<Vec<_>>());
    }
}

/// Adds the dots: the photons that `stories` store, those that another list moved, and what it has
/// besides.
fn add_dots(columns: &mut PackedColumns, stories: &[Story], exploration: &Exploration) {
    let stored: Vec<_> = stories
        .iter()
        .flat_map(|story| story.hits.iter().skip(1).map(move |hit| (story.photon as u32, hit)))
        .collect();
    let overlay = match exploration.comparison {
        Some(comparison) => {
            comparison.overlay(&stored_places(stories, exploration.records), stored.len())
        }
        None => Overlay { kinds: vec![0; stored.len()], ..Overlay::default() },
    };
    let Overlay { kinds, positions, moved_index, extra } = &overlay;
    let moved = || moved_index.iter().map(|at| &stored[*at as usize]);
    let mut all: Vec<_> = stored.iter().map(|(_, hit)| hit.position).collect();
    all.extend(positions);
    columns.vectors("dotPosition", &all);
    columns.bytes("dotKind", kinds);
    columns.words("movedIndex", moved_index);
    // What a list does not tell is the largest number.
    let photons = moved().map(|(photon, _)| *photon).chain(extra.iter().map(|it| it.photon));
    columns.words("otherPhoton", &photons.collect::<Vec<_>>());
    let bounces = moved().map(|(_, hit)| hit.bounce as u16);
    let bounces = bounces.chain(extra.iter().map(|it| it.bounce));
    columns.shorts("otherBounce", &bounces.collect::<Vec<_>>());
    let surfaces = moved().map(|(_, hit)| hit.surface_index as u16);
    let surfaces = surfaces.chain(extra.iter().map(|it| it.surface));
    columns.shorts("otherSurface", &surfaces.collect::<Vec<_>>());
}

/// Whether the direction in which a photon leaves is its last try, normalized.
fn emission_follows(story: &Story) -> bool {
    let last = story.emission.tries.last().copied().unwrap_or_default();
    let [x, y, z] = last;
    let by = 1.0 / (x * x + y * y + z * z).sqrt();
    last.map(|component| (component * by).to_bits()) == story.emission.direction.map(f32::to_bits)
}

/// Whether a photon's first hit is where its ray is after the distance t.
fn direct_follows(story: &Story, run: &Run) -> bool {
    let light = run.placement.to_world(run.scene().lights()[story.emission.light].position);
    let direction = Vec3::from_array(story.emission.direction);
    story.hits.first().is_none_or(|hit| {
        let point = light + hit.t * direction;
        point.to_array().map(f32::to_bits) == hit.position.map(f32::to_bits)
    })
}
