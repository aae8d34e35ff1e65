//! Third and later hits, and how the hits of one path go together, on a mesh.
//!
//! A is the operator (A f)(x) = P_r(x) * mean of f over the cosine lobe of x. With f_b = 1 on facet
//! b, the expected hits are N_k,b = integral of n2 A^(k-2) f_b. On the mesh (collocation, piecewise
//! linear) n2 becomes weights a_2 at the nodes, and a_{k+1} = A^T a_k. The first factor, g_b = A
//! f_b = P_r times the form factor of b, is exact at every node: N_{k+1},b = a_k . g_b.

use super::direct::Direct;
use super::mesh::{Mesh, PlateView, TransportRow};
use super::scene::{PlateScene, Side};
use super::solid_angle::form_factor;
use super::triangle_rules::TriangleRule;
use super::visibility::seen_from_plate;
use rayon::prelude::*;

/// What A needs at one node.
struct QuadratureNode {
    plate: usize,
    /// (cell, weights of its three nodes), already times P_r.
    row: Vec<(u32, [f64; 3])>,
    /// g_b for every plate b.
    to_plates: Vec<f64>,
    /// In square scene units.
    area: f64,
    /// n2 times the area.
    second_hits: f64,
}

/// Results of one mesh.
pub struct Bounces {
    /// `hits[k][b]`: expected hits number k + 1 on plate b; k = 0 and 1 are as given.
    pub hits: Vec<Vec<f64>>,
    /// E[sum over j < k of I_j,a I_k,b] for 2 <= j, for surfaces a and b.
    pub ordered_pairs: Vec<Vec<f64>>,
}

/// Fewer hits than this per emitted photon and bounce are not followed further.
const NEGLIGIBLE: f64 = 1e-15;

/// Follows hits from the second on over a mesh, at most `most` of them.
///
/// `known` holds the exact hits per plate of bounces 1, 2 and, if known, 3. The weights at the
/// nodes are scaled to them plate by plate, which takes out most of the quadrature's error.
/// `surface_of` numbers each plate's surface.
pub fn follow(
    scene: &PlateScene,
    direct: &Direct,
    mesh: &Mesh,
    known: &[Vec<f64>],
    surface_of: &[usize],
    most: usize,
) -> Bounces {
    let nodes = nodes(scene, direct, mesh);
    let mut weights: Vec<f64> = nodes.iter().map(|node| node.second_hits).collect();
    scale_to(&mut weights, &nodes, &known[1]);
    let mut hits = known[..2].to_vec();
    let mut stages = vec![weights];
    while hits.len() < most && hits.last().is_some_and(|last| last.iter().sum::<f64>() > NEGLIGIBLE)
    {
        let weights = &stages[stages.len() - 1];
        let mut next = vec![0.0; scene.plates.len()];
        let mut scattered = vec![0.0; weights.len()];
        for (node, &weight) in nodes.iter().zip(weights) {
            if weight != 0.0 {
                next.iter_mut()
                    .zip(&node.to_plates)
                    .for_each(|(sum, chance)| *sum += weight * chance);
                for (cell, shares) in &node.row {
                    let base = 3 * *cell as usize;
                    (0..3).for_each(|i| scattered[base + i] += weight * shares[i]);
                }
            }
        }
        if let Some(exact) = known.get(hits.len()) {
            next.clone_from(exact);
            scale_to(&mut scattered, &nodes, exact);
        }
        hits.push(next);
        stages.push(scattered);
    }
    let ordered_pairs = pairs(&nodes, &stages, surface_of);
    Bounces { hits, ordered_pairs }
}

fn nodes(scene: &PlateScene, direct: &Direct, mesh: &Mesh) -> Vec<QuadratureNode> {
    let rule = TriangleRule::radon();
    let at_nodes: Vec<(usize, usize)> =
        (0..mesh.cells.len()).flat_map(|cell| (0..3).map(move |i| (cell, i))).collect();
    at_nodes
        .into_par_iter()
        .map_init(
            || TransportRow::new(mesh.cells.len()),
            |row, (cell, i)| {
                let cell = &mesh.cells[cell];
                let plate = &scene.plates[cell.plate];
                let view = PlateView {
                    eye: cell.nodes[i],
                    normal: plate.plane.normal,
                    rule: &rule,
                    ratio: 1.0,
                };
                let mut to_plates = vec![0.0; scene.plates.len()];
                for (target, sum) in to_plates.iter_mut().enumerate() {
                    for seen in seen_from_plate(scene, cell.plate, Side::Front, view.eye, target) {
                        *sum += plate.survival * form_factor(&seen, view.eye, view.normal);
                        mesh.gather(scene, &view, target, seen, row);
                    }
                }
                let mut row = row.take();
                row.iter_mut()
                    .for_each(|(_, shares)| *shares = shares.map(|share| share * plate.survival));
                let area = cell.area / 3.0;
                let second_hits = direct.second_hit_density(scene, cell.plate, view.eye) * area;
                QuadratureNode { plate: cell.plate, row, to_plates, area, second_hits }
            },
        )
        .collect()
}

/// Scales the weights on each plate so that they sum to `exact`; where all nodes missed, spreads it
/// evenly.
fn scale_to(weights: &mut [f64], nodes: &[QuadratureNode], exact: &[f64]) {
    let (mut sums, mut areas) = (vec![0.0; exact.len()], vec![0.0; exact.len()]);
    for (node, weight) in nodes.iter().zip(&*weights) {
        sums[node.plate] += weight;
        areas[node.plate] += node.area;
    }
    for (node, weight) in nodes.iter().zip(weights) {
        let plate = node.plate;
        *weight = if sums[plate] > 0.0 {
            *weight * (exact[plate] / sums[plate])
        } else {
            exact[plate] * node.area / areas[plate]
        };
    }
}

/// Sum over 2 <= j < k <= most of E[I_j,a I_k,b] = a_j . (g_b + A g_b + ... + A^(most - j - 1) g_b)
/// over the nodes of a.
fn pairs(nodes: &[QuadratureNode], stages: &[Vec<f64>], surface_of: &[usize]) -> Vec<Vec<f64>> {
    /// So many surfaces b are followed at once: their numbers lie side by side.
    const ABREAST: usize = 4;
    let surfaces = surface_of.iter().max().map_or(0, |&highest| highest + 1);
    let mut pairs = vec![vec![0.0; surfaces]; surfaces];
    for start in (0..surfaces).step_by(ABREAST) {
        let to_surfaces = |node: &QuadratureNode| {
            let mut sums = [0.0; ABREAST];
            for (chance, surface) in node.to_plates.iter().zip(surface_of) {
                if let Some(sum) = surface.checked_sub(start).and_then(|at| sums.get_mut(at)) {
                    *sum += chance;
                }
            }
            sums
        };
        let first: Vec<[f64; ABREAST]> = nodes.iter().map(to_surfaces).collect();
        let mut further = first.clone();
        for weights in stages.iter().rev().skip(1) {
            for ((node, weight), chances) in nodes.iter().zip(weights).zip(&further) {
                let row = &mut pairs[surface_of[node.plate]][start..];
                row.iter_mut().zip(chances).for_each(|(sum, chance)| *sum += weight * chance);
            }
            let next = |(node, first): (&QuadratureNode, &[f64; ABREAST])| {
                let mut sums = *first;
                for (cell, shares) in &node.row {
                    for (share, chances) in shares.iter().zip(&further[3 * *cell as usize..]) {
                        sums.iter_mut().zip(chances).for_each(|(sum, it)| *sum += share * it);
                    }
                }
                sums
            };
            further = nodes.par_iter().zip(&first).map(next).collect();
        }
    }
    pairs
}
