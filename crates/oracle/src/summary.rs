//! A run held against what is expected: photons by surface and bounce.

use serde::{Deserialize, Serialize};

use crate::Bounded;
use crate::table::ExpectedTable;
use crate::text_table::align;
use photon_mapping::photon_list::PhotonRecord;

/// Counts of stored photons, surface by bounce.
#[derive(Clone, Debug)]
pub struct Tally {
    names: Vec<String>,
    counts: Vec<Vec<u64>>,
    /// The emitted photon whose records are coming in. The next two fields count, by surface, those
    /// beyond the bounces with a column of their own: their spread is not known in advance.
    current: u32,
    late_of_current: Vec<u64>,
    late_squares: Vec<u64>,
}

/// Bounces up to this one have a column of their own in the table.
const COLUMNS: usize = 3;

impl Tally {
    /// An empty tally for surfaces of these names.
    pub fn new(names: impl IntoIterator<Item = String>) -> Self {
        let names: Vec<_> = names.into_iter().collect();
        let surfaces = names.len();
        Self {
            names,
            counts: vec![Vec::new(); surfaces],
            current: u32::MAX,
            late_of_current: vec![0; surfaces + 1],
            late_squares: vec![0; surfaces + 1],
        }
    }

    /// Counts a record; those of one emitted photon must come one after another.
    pub fn add(&mut self, record: &PhotonRecord) {
        let (surface, bounce) = (usize::from(record.surface), usize::from(record.bounce));
        let counts = &mut self.counts[surface];
        if counts.len() < bounce {
            counts.resize(bounce, 0);
        }
        counts[bounce - 1] += 1;
        if bounce > COLUMNS {
            if record.photon != self.current {
                self.current = record.photon;
                self.late_of_current.fill(0);
            }
            for group in [surface, self.names.len()] {
                // The squares of 0, 1, 2, ... differ by 1, 3, 5, ...
                self.late_squares[group] += 2 * self.late_of_current[group] + 1;
                self.late_of_current[group] += 1;
            }
        }
    }

    /// What was counted, to be added up with the counts of other pieces of the run.
    pub fn counts(&self) -> Counts {
        let Self { names, counts, late_squares, .. } = self.clone();
        Counts { names, by_surface_and_bounce: counts, late_squares }
    }

    /// Adds the counts of another piece of the run, and says whether they are of the same surfaces;
    /// nothing is added if not.
    #[must_use]
    pub fn add_counts(&mut self, other: &Counts) -> bool {
        let surfaces = self.names.len();
        let has_columns = other.by_surface_and_bounce.len() == surfaces;
        if other.names != self.names || !has_columns || other.late_squares.len() != surfaces + 1 {
            return false;
        }
        for (counts, other) in self.counts.iter_mut().zip(&other.by_surface_and_bounce) {
            counts.resize(counts.len().max(other.len()), 0);
            counts.iter_mut().zip(other).for_each(|(count, other)| *count += other);
        }
        self.late_squares
            .iter_mut()
            .zip(&other.late_squares)
            .for_each(|(sum, other)| *sum += other);
        true
    }

    /// All photons counted.
    pub fn stored(&self) -> u64 {
        self.counts.iter().flatten().sum()
    }

    /// The tally of `emitted` photons that bounced at most `max_bounces` times beside `expected`:
    /// a line for every surface, and the total.
    pub fn surfaces(
        &self,
        emitted: u64,
        max_bounces: usize,
        expected: Option<&ExpectedTable>,
    ) -> (Vec<SurfaceSummary>, SurfaceSummary) {
        let groups = self.names.len();
        let mut lines: Vec<_> = (0..=groups)
            .map(|group| {
                let is_total = group == groups;
                let members = if is_total { 0..groups } else { group..group + 1 };
                let name = if is_total { "total".to_owned() } else { self.names[group].clone() };
                let count = |bounce: usize| -> u64 {
                    let of = |surface: usize| self.counts[surface].get(bounce - 1).copied();
                    members.clone().filter_map(of).sum()
                };
                let law = expected.map(|expected| law(expected, members.clone(), max_bounces));
                let last = members.clone().map(|s| self.counts[s].len()).max().unwrap_or(0);
                let by_bounce = (1..=last.max(COLUMNS))
                    .map(|bounce| {
                        let mean = law
                            .as_ref()
                            .map(|law| law.by_bounce.get(bounce - 1).copied().unwrap_or_default());
                        // One photon is stored at most once at its k-th bounce: a binomial.
                        let variance = mean.map(|mean| mean.value * (1.0 - mean.value));
                        SummaryCell::new(bounce, count(bounce), emitted, mean, variance)
                    })
                    .collect();
                let sum = |first: usize| (first..=last).map(count).sum::<u64>();
                let mean = |first: usize| {
                    law.as_ref().map(|law| law.by_bounce.iter().skip(first - 1).copied().sum())
                };
                let measured = self.late_squares[group] as f64 / emitted as f64
                    - (sum(COLUMNS + 1) as f64 / emitted as f64).powi(2);
                let first = COLUMNS + 1;
                let late =
                    SummaryCell::new(first, sum(first), emitted, mean(first), Some(measured));
                let variance = law.as_ref().and_then(|law| law.variance);
                let all = SummaryCell::new(0, sum(1), emitted, mean(1), variance);
                let stored = all.stored;
                SurfaceSummary { name, stored, expected: all.expected, z: all.z, by_bounce, late }
            })
            .collect();
        let total = lines.pop().expect("the last line is the total");
        (lines, total)
    }
}

/// What a [`Tally`] has counted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// The surfaces' names.
    pub names: Vec<String>,
    /// Photons stored, surface by bounce, the first bounce first.
    pub by_surface_and_bounce: Vec<Vec<u64>>,
    /// For each surface, then for all together: the sum over emitted photons of the square of how
    /// many they stored beyond the bounces that have a column of their own.
    pub late_squares: Vec<u64>,
}

struct CountLaw {
    /// Expected photons stored per emitted photon, and a bound on the error, from bounce 1 on.
    by_bounce: Vec<Bounded>,
    /// Variance of all of them together; unknown where paths are cut short.
    variance: Option<f64>,
}

fn law(expected: &ExpectedTable, members: std::ops::Range<usize>, max_bounces: usize) -> CountLaw {
    let bounces = expected.total.hits.len().saturating_sub(1);
    let cell = |surface: usize, bounce: usize| {
        let row = &expected.surfaces[surface];
        Bounded { value: row.hits[bounce], error: row.error[bounce] }
    };
    let by_bounce = (1..=bounces.min(max_bounces))
        .map(|bounce| members.clone().map(|surface| cell(surface, bounce)).sum())
        .collect();
    let pairs = members.clone().flat_map(|a| members.clone().map(move |b| (a, b)));
    let variance = pairs.map(|(a, b)| expected.covariance[a][b]).sum();
    CountLaw { by_bounce, variance: (max_bounces >= bounces).then_some(variance) }
}

/// One number of the table.
#[derive(Clone, Debug, Serialize)]
pub struct SummaryCell {
    /// How often the photons had bounced.
    pub bounce: usize,
    /// How many were stored.
    pub stored: u64,
    /// How many were expected.
    pub expected: Option<f64>,
    /// By how many standard deviations they differ; none below five expected, where the normal law
    /// does not hold.
    pub z: Option<f64>,
}

impl SummaryCell {
    fn new(
        bounce: usize,
        stored: u64,
        emitted: u64,
        mean: Option<Bounded>,
        variance: Option<f64>,
    ) -> Self {
        let photons = emitted as f64;
        let expected = mean.map(|mean| mean.value * photons);
        let z = mean.zip(variance).and_then(|(mean, variance)| {
            let deviation = (variance * photons + (mean.error * photons).powi(2)).sqrt();
            let expected = mean.value * photons;
            (expected >= 5.0 && deviation > 0.0).then(|| (stored as f64 - expected) / deviation)
        });
        Self { bounce, stored, expected, z }
    }
}

/// One line of the table.
#[derive(Clone, Debug, Serialize)]
pub struct SurfaceSummary {
    /// The mesh object's name, or `total`.
    pub name: String,
    /// How many photons were stored on it.
    pub stored: u64,
    /// How many were expected.
    pub expected: Option<f64>,
    /// By how many standard deviations they differ. The photons of one path are correlated, so the
    /// deviation comes from the covariance of whole paths.
    pub z: Option<f64>,
    /// The same for each bounce, from the first on.
    pub by_bounce: Vec<SummaryCell>,
    /// Those that bounced more often than the table has columns, together.
    #[serde(skip)]
    pub late: SummaryCell,
}

impl SurfaceSummary {
    /// Removes all differences in standard deviations, where photons are not independent.
    pub fn forget_z(&mut self) {
        self.z = None;
        self.by_bounce.iter_mut().chain([&mut self.late]).for_each(|cell| cell.z = None);
    }
}

/// The table as text, a line for every surface and one for the total.
pub fn table(surfaces: &[SurfaceSummary]) -> String {
    let mut heads = vec!["surface".to_owned()];
    heads.extend((1..=COLUMNS).map(|bounce| format!("bounce {bounce}")));
    heads.extend([format!("bounce {}+", COLUMNS + 1), "stored".to_owned()]);
    let mut rows = vec![heads];
    for surface in surfaces {
        let mut row = vec![surface.name.clone()];
        let whole = SummaryCell {
            bounce: 0,
            stored: surface.stored,
            expected: surface.expected,
            z: surface.z,
        };
        let shown = surface.by_bounce.iter().take(COLUMNS).chain([&surface.late, &whole]);
        row.extend(shown.map(|cell| {
            let expected = cell.expected.map(|expected| format!(" / {expected:.1}"));
            let z = cell.z.map(|z| format!(" ({z:+.1})"));
            format!("{}{}{}", cell.stored, expected.unwrap_or_default(), z.unwrap_or_default())
        }));
        rows.push(row);
    }
    align(&rows)
}
