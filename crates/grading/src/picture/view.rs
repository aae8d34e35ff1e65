//! What the handout's camera sees: for every pixel the point it shows, and which part of which
//! facet that is.

use std::collections::BTreeMap;

use glam::Vec3;
use image::RgbImage;

use crate::limits::view::{NEIGHBORS, PATCH, SHARES};
use crate::places::{MARGIN, Place, Places};
use photon_mapping::assignment8::{HEIGHT, WIDTH, create_camera, create_scene};
use photon_mapping::rendering::backward_renderer::compute_sample_color;
use photon_mapping::rendering::image_writer::to_bytes;
use photon_mapping::rendering::photon_mapping_renderer::PHOTON_DOT_RADIUS;
use photon_mapping::scene::camera::PerspectiveCamera;
use photon_mapping::scene::ray::IntersectionState;

/// No patch.
const NONE: u32 = u32::MAX;

/// All pixels of a picture.
pub const PIXELS: usize = (WIDTH * HEIGHT) as usize;

/// The pixels of one facet in one square of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    /// The facet, of [`View::facets`].
    pub facet_in_sight: usize,
    /// The cell, of [`View::cells`].
    pub cell: usize,
    /// How many pixels.
    pub pixels: u32,
    /// How many it has in the view with which signatures are measured.
    pub measured: u32,
}

/// Pairs of pixels, one in each of two patches, of which the second is no lower in number, whose
/// cubes overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlap {
    /// The patches.
    pub patches: [usize; 2],
    /// How many ordered pairs share a part of `(at + 0.5) / SHARES` of the facet in their cubes;
    /// the last entry has the pixels paired with themselves, which share all.
    pub pairs: [u32; SHARES + 1],
}

/// What the handout's camera sees.
#[derive(Clone, Debug)]
pub struct View {
    camera: PerspectiveCamera,
    /// By how much of a pixel rays are shifted to the right and downwards.
    shift: f32,
    /// By pixel, row by row: the point it shows in scene space, or NaN.
    points: Vec<Vec3>,
    /// By pixel: its patch, or [`NONE`].
    patch_of: Vec<u32>,
    /// The patches.
    pub patches: Vec<Patch>,
    /// The facets in sight, by their number in [`Places`].
    pub facets: Vec<usize>,
    /// The cells in sight, by their number in [`Places`].
    pub cells: Vec<usize>,
    /// By cell of [`Self::cells`], its facet of [`Self::facets`].
    pub facet_of_cell: Vec<usize>,
    /// By facet in sight: the axis closest to its normal.
    steepest: Vec<usize>,
    /// Overlapping pairs, by patches.
    pub overlaps: Vec<Overlap>,
    /// The direct light.
    pub direct: RgbImage,
}

/// What one pixel shows: a point of a facet, and its direct light.
type Seen = (Option<(Vec3, usize)>, [u8; 3]);

/// Where `point` appears in the picture of `camera`, from (0, 0) in the top left corner to (1, 1);
/// `None` for a point that is not in front of the camera.
fn project(camera: &PerspectiveCamera, point: Vec3) -> Option<[f32; 2]> {
    let from = point - camera.position;
    let depth = from.dot(camera.forward);
    let across = from.dot(camera.right) / (depth * camera.half_width);
    let upwards = from.dot(camera.up) / (depth * camera.half_height);
    (depth > 0.0).then(|| [(across + 1.0) / 2.0, (1.0 - upwards) / 2.0])
}

/// What every pixel shows, with rays through (column + shift, row + shift), in pixels.
fn see(camera: &PerspectiveCamera, shift: f32) -> Vec<Seen> {
    let scene = create_scene();
    let facet_of_triangle = model::facets::facet_of_triangles(&scene);
    let see = |pixel: usize| {
        let (column, row) = (pixel % WIDTH as usize, pixel / WIDTH as usize);
        let ray = camera.generate_ray_for_normalized_coordinates(
            (column as f32 + shift) / WIDTH as f32,
            (row as f32 + shift) / HEIGHT as f32,
        );
        let mut state = IntersectionState::new();
        if !scene.trace(&ray, Some(&mut state)) {
            return (None, to_bytes(Vec3::ZERO));
        }
        let facet = facet_of_triangle[state.intersected_primitive];
        let direct = to_bytes(compute_sample_color(&scene, &state));
        (Some((state.intersection_point(), facet)), direct)
    };
    (0..PIXELS).map(see).collect()
}

impl View {
    /// The view of the framework, whose rays go through the upper left corners of pixels.
    pub fn new(places: &Places) -> Self {
        let camera = create_camera(WIDTH, HEIGHT);
        let seen = see(&camera, 0.0);
        let mut of_patches: BTreeMap<[usize; 4], Vec<usize>> = BTreeMap::new();
        for (pixel, (seen, _)) in seen.iter().enumerate() {
            let Some((point, facet)) = *seen else { continue };
            if let Some(cell) = cell_inside(places, facet, point) {
                let (column, row) = (pixel % WIDTH as usize, pixel / WIDTH as usize);
                let patch = [facet, cell, row / PATCH, column / PATCH];
                of_patches.entry(patch).or_default().push(pixel);
            }
        }
        let sorted = |mut all: Vec<usize>| {
            all.sort_unstable();
            all.dedup();
            all
        };
        let facets = sorted(of_patches.keys().map(|patch| patch[0]).collect());
        let cells = sorted(of_patches.keys().map(|patch| patch[1]).collect());
        let mut patches = Vec::new();
        let mut patch_of = vec![NONE; PIXELS];
        for ([facet, cell, ..], pixels) in &of_patches {
            for pixel in pixels {
                patch_of[*pixel] = patches.len() as u32;
            }
            let facet_in_sight = facets.partition_point(|in_sight| in_sight < facet);
            let cell = cells.partition_point(|in_sight| in_sight < cell);
            let pixels = pixels.len() as u32;
            patches.push(Patch { facet_in_sight, cell, pixels, measured: pixels });
        }
        Self::assemble(camera, 0.0, &seen, (patches, patch_of), (facets, cells), places)
    }

    /// The view through the middles of pixels, with the same patches.
    pub fn shifted(&self, places: &Places) -> Self {
        const SHIFT: f32 = 0.5;
        let seen = see(&self.camera, SHIFT);
        let mut patches = self.patches.clone();
        patches.iter_mut().for_each(|patch| patch.pixels = 0);
        let mut patch_of = vec![NONE; PIXELS];
        for (pixel, (seen, _)) in seen.iter().enumerate() {
            let (Some((point, facet)), Some(patch)) = (*seen, self.patch(pixel)) else { continue };
            let is_same = self.facets[self.patches[patch].facet_in_sight] == facet;
            if is_same && cell_inside(places, facet, point).is_some() {
                patches[patch].pixels += 1;
                patch_of[pixel] = patch as u32;
            }
        }
        let in_sight = (self.facets.clone(), self.cells.clone());
        Self::assemble(self.camera, SHIFT, &seen, (patches, patch_of), in_sight, places)
    }

    fn assemble(
        camera: PerspectiveCamera,
        shift: f32,
        seen: &[Seen],
        (patches, patch_of): (Vec<Patch>, Vec<u32>),
        (facets, cells): (Vec<usize>, Vec<usize>),
        places: &Places,
    ) -> Self {
        let direct = seen.iter().flat_map(|(_, color)| *color).collect();
        let direct =
            RgbImage::from_raw(WIDTH, HEIGHT, direct).expect("three bytes for every pixel");
        let point = |(seen, _): &Seen| seen.map_or(Vec3::NAN, |(point, _)| point);
        let points = seen.iter().map(point).collect();
        let mut facet_of_cell = vec![0; cells.len()];
        patches.iter().for_each(|patch| facet_of_cell[patch.cell] = patch.facet_in_sight);
        let steepest = |facet: &usize| places.facets[*facet].normal.abs().max_position();
        let steepest = facets.iter().map(steepest).collect();
        let overlaps = Vec::new();
        let mut view = Self {
            camera,
            shift,
            points,
            patch_of,
            patches,
            facets,
            cells,
            facet_of_cell,
            steepest,
            overlaps,
            direct,
        };
        view.overlaps = view.find_overlaps();
        view
    }

    /// Whether a pixel shows a surface.
    pub fn shows_surface(&self, pixel: usize) -> bool {
        !self.points[pixel].is_nan()
    }

    /// The patch of a pixel, if it is far enough from all edges.
    pub fn patch(&self, pixel: usize) -> Option<usize> {
        let patch = self.patch_of[pixel];
        (patch != NONE).then_some(patch as usize)
    }

    /// Calls `found` with every pixel that a photon at `position`, in scene space, turns red.
    pub fn for_each_pixel_of(&self, position: Vec3, mut found: impl FnMut(usize)) {
        let radius = PHOTON_DOT_RADIUS;
        let Some([x, y]) = project(&self.camera, position) else { return };
        // A cube that is this far away is at most 1.5 pixels to either side of its middle; what the
        // window has too much, the points themselves sort out.
        let window = |at: f32, size: u32| {
            let at = at * size as f32 - self.shift;
            let low = (at - NEIGHBORS as f32).ceil().max(0.0) as usize;
            let high = (at + NEIGHBORS as f32).floor().min(size as f32 - 1.0);
            low..(high + 1.0).max(0.0) as usize
        };
        for row in window(y, HEIGHT) {
            for column in window(x, WIDTH) {
                let pixel = row * WIDTH as usize + column;
                // What shows nothing is NaN, and no comparison holds.
                if (position - self.points[pixel]).abs().cmple(Vec3::splat(radius)).all() {
                    found(pixel);
                }
            }
        }
    }

    /// The part of its facet in the cube around `pixel` that is in the one around `other`, too,
    /// where both show the facet of `patch`.
    pub fn share(&self, pixel: usize, other: usize, patch: usize) -> f64 {
        let edge = 2.0 * f64::from(PHOTON_DOT_RADIUS);
        let apart = (self.points[pixel] - self.points[other]).as_dvec3().abs();
        // Seen along the axis closest to the normal, it is a square.
        let steepest = self.steepest[self.patches[patch].facet_in_sight];
        let axes = (0..3).filter(|axis| *axis != steepest);
        axes.map(|axis| (1.0 - apart[axis] / edge).max(0.0)).product()
    }

    fn find_overlaps(&self) -> Vec<Overlap> {
        let none = [0; SHARES + 1];
        // Nearly all pairs are of one patch.
        let mut within = vec![none; self.patches.len()];
        let mut pairs: BTreeMap<[usize; 2], [u32; SHARES + 1]> = BTreeMap::new();
        for pixel in 0..PIXELS {
            let Some(patch) = self.patch(pixel) else { continue };
            let facet = self.patches[patch].facet_in_sight;
            let (column, row) =
                ((pixel % WIDTH as usize) as isize, (pixel / WIDTH as usize) as isize);
            for down in -NEIGHBORS..=NEIGHBORS {
                for right in -NEIGHBORS..=NEIGHBORS {
                    let (row, column) = (row + down, column + right);
                    if !(0..HEIGHT as isize).contains(&row)
                        || !(0..WIDTH as isize).contains(&column)
                    {
                        continue;
                    }
                    let other = row as usize * WIDTH as usize + column as usize;
                    let Some(other_patch) = self.patch(other) else { continue };
                    let is_counted = other_patch < patch;
                    if is_counted || self.patches[other_patch].facet_in_sight != facet {
                        continue;
                    }
                    let share = self.share(pixel, other, patch);
                    if share > 0.0 {
                        let at =
                            if other == pixel { SHARES } else { (share * SHARES as f64) as usize };
                        let pairs = match other_patch == patch {
                            true => &mut within[patch],
                            false => pairs.entry([patch, other_patch]).or_insert(none),
                        };
                        pairs[at.min(SHARES)] += 1;
                    }
                }
            }
        }
        let within = within.into_iter().enumerate().filter(|(_, pairs)| *pairs != none);
        pairs.extend(within.map(|(patch, pairs)| ([patch, patch], pairs)));
        pairs.into_iter().map(|(patches, pairs)| Overlap { patches, pairs }).collect()
    }
}

/// The cell of `facet` that `point` is in, if it is far enough from all edges.
fn cell_inside(places: &Places, facet: usize, point: Vec3) -> Option<usize> {
    let point = point.as_dvec3();
    let corners = places.facets[facet].corners;
    // The cube of a dot reaches over edges, and the photons there may belong to either facet.
    let is_near_edge = (0..4).any(|corner| {
        let (a, b) = (corners[corner], corners[(corner + 1) % 4]);
        (point - a).cross(b - a).length() < MARGIN * (b - a).length()
    });
    match places.place(point) {
        Place::Cell { facet: placed, cell } if placed == facet && !is_near_edge => Some(cell),
        _ => None,
    }
}
