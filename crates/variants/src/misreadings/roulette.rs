//! Misreadings of what decides whether a photon is scattered.

use super::Entry;
use crate::section::Section;
use crate::variation::{Roulette, Variation};

pub(super) fn roulette() -> Vec<Entry> {
    let of = |roulette| Variation { roulette, ..Variation::default() };
    let section = Section::PhotonScatteringAbsorption;
    let largest = "Equation (1): P_r = max(d_r, d_g, d_b).";
    let even =
        "Draw a number in [0, 1), and scatter where it is less than P_r = max(d_r, d_g, d_b).";
    let mut no_roulette = Entry::new(
        "no-roulette",
        section,
        "Scatter only if a random number in [0, 1) is less than P_r, which equation (1) takes from \
         the material that was hit, and end the path otherwise.",
        [],
    );
    for tenths in 1..=9_u8 {
        let chance = f32::from(tenths) / 10.0;
        let title = format!("photons survive with the same chance, {chance}, on every material");
        no_roulette.ways.push((title, of(Roulette::Constant(chance))));
    }
    for most_bounces in [2, 3, 4, 5, 6, 8, 10, 20] {
        let title = format!("every photon is scattered, up to {most_bounces} times");
        let always = of(Roulette::Constant(1.0));
        no_roulette.ways.push((title, Variation { most_bounces: Some(most_bounces), ..always }));
    }
    let late = |sure_hits| Variation { sure_hits, ..Variation::default() };
    vec![
        Entry::new(
            "mean-roulette",
            section,
            largest,
            [(
                "photons survive with the mean of the diffuse response, not its maximum",
                of(Roulette::Mean),
            )],
        ),
        Entry::new(
            "red-roulette",
            section,
            largest,
            [(
                "photons survive with the red of the diffuse response alone, not its maximum",
                of(Roulette::Red),
            )],
        ),
        Entry::new(
            "smallest-roulette",
            section,
            largest,
            [(
                "photons survive with the smallest channel of the diffuse response, not its \
                 largest",
                of(Roulette::Smallest),
            )],
        ),
        Entry::new(
            "luminance-roulette",
            section,
            largest,
            [
                (
                    "photons survive with the luminance of the diffuse response, not its largest \
                     channel",
                    of(Roulette::Weighted([0.2126, 0.7152, 0.0722])),
                ),
                (
                    "photons survive with the luma of the diffuse response, not its largest \
                     channel",
                    of(Roulette::Weighted([0.299, 0.587, 0.114])),
                ),
            ],
        ),
        Entry::new(
            "squared-roulette",
            section,
            "P_r is applied twice: one number decides, once, whether the photon is scattered.",
            [("photons survive with the square of P_r", of(Roulette::Squared))],
        ),
        Entry::new(
            "shifted-roulette",
            section,
            even,
            [
                ("photons survive with P_r + 0.1", of(Roulette::Shifted(0.1))),
                ("photons survive with P_r - 0.1", of(Roulette::Shifted(-0.1))),
            ],
        ),
        Entry::new(
            "signed-roulette",
            section,
            even,
            [("a number in [-1, 1) is held against P_r", of(Roulette::Signed))],
        ),
        Entry::new(
            "inverted-roulette",
            section,
            "Scatter where the number is LESS than P_r; above, the photon is absorbed.",
            [("photons are scattered where they should be absorbed", of(Roulette::Inverted))],
        ),
        Entry::new(
            "late-roulette",
            section,
            "The roulette decides at every hit, the first one included.",
            [
                ("the first hit always scatters", late(1)),
                ("the first two hits always scatter", late(2)),
                ("the first three hits always scatter", late(3)),
                ("the first four hits always scatter", late(4)),
                ("the first five hits always scatter", late(5)),
            ],
        ),
        no_roulette,
    ]
}
