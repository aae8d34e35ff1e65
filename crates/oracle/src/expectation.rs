//! What the oracle answers.

use serde::{Deserialize, Serialize};

/// A number and a bound on its error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bounded {
    /// The number.
    pub value: f64,
    /// It is off by no more than this.
    pub error: f64,
}

impl std::iter::Sum for Bounded {
    fn sum<I: Iterator<Item = Self>>(items: I) -> Self {
        items.fold(Self::default(), |sum, item| Self {
            value: sum.value + item.value,
            error: sum.error + item.error,
        })
    }
}

/// Expected hits on one facet per emitted photon. Entry k is hit number k + 1 of a path: 0 the
/// direct hits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FacetHits {
    /// Number of the surface it belongs to.
    pub surface: usize,
    /// Chance that a hit here is scattered, as given.
    pub survival: f64,
    /// Hits per emitted photon.
    pub hits: Vec<f64>,
    /// Bound on the error of each entry of `hits`.
    pub error: Vec<f64>,
}

impl FacetHits {
    /// Hit number `bounce` (1 is the direct hit); zero beyond the last one followed.
    pub fn hit(&self, bounce: usize) -> Bounded {
        let entry =
            |list: &[f64]| bounce.checked_sub(1).and_then(|k| list.get(k)).copied().unwrap_or(0.0);
        Bounded { value: entry(&self.hits), error: entry(&self.error) }
    }

    /// Hits number `first` and later.
    pub fn from(&self, first: usize) -> Bounded {
        (first.max(1)..=self.hits.len()).map(|bounce| self.hit(bounce)).sum()
    }
}

/// Expected hits per emitted photon, and how those stored on one path vary together.
///
/// Stored hits are number 2 and later.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Expectation {
    /// In the order the facets were given.
    pub facets: Vec<FacetHits>,
    /// The surface numbers that occur, ascending: the order of the rows and columns of
    /// `covariance`.
    pub surfaces: Vec<usize>,
    /// Covariance, over paths, of the numbers of hits stored on two surfaces.
    pub covariance: Vec<Vec<Bounded>>,
}

impl Expectation {
    /// Number of hits followed along a path.
    pub fn bounces(&self) -> usize {
        self.facets.iter().map(|facet| facet.hits.len()).max().unwrap_or(0)
    }

    /// Hits number `bounce` (1 is the direct hit) on a surface.
    pub fn on_surface(&self, surface: usize, bounce: usize) -> Bounded {
        self.of(surface).map(|facet| facet.hit(bounce)).sum()
    }

    /// Hits number `first` and later on a surface.
    pub fn on_surface_from(&self, surface: usize, first: usize) -> Bounded {
        self.of(surface).map(|facet| facet.from(first)).sum()
    }

    /// Hits number `bounce` on all facets.
    pub fn total(&self, bounce: usize) -> Bounded {
        self.facets.iter().map(|facet| facet.hit(bounce)).sum()
    }

    /// Hits number `first` and later on all facets.
    pub fn total_from(&self, first: usize) -> Bounded {
        self.facets.iter().map(|facet| facet.from(first)).sum()
    }

    /// Stored hits on all facets.
    pub fn stored(&self) -> Bounded {
        self.total_from(2)
    }

    /// Photons scattered per emitted photon; a photon counts each time.
    pub fn scattered(&self) -> Bounded {
        self.weighted(|facet| facet.survival)
    }

    /// Photons absorbed per emitted photon. The others escape.
    pub fn absorbed(&self) -> Bounded {
        self.weighted(|facet| 1.0 - facet.survival)
    }

    /// Variance, over paths, of the number of stored hits.
    pub fn variance(&self) -> Bounded {
        self.covariance.iter().flatten().copied().sum()
    }

    /// Variance over mean of the number of stored hits: 1 if photons were independent. Zero if none
    /// is stored.
    pub fn spread(&self) -> Bounded {
        let (variance, stored) = (self.variance(), self.stored());
        if stored.value <= 0.0 {
            return Bounded::default();
        }
        let value = variance.value / stored.value;
        Bounded { value, error: (variance.error + value * stored.error) / stored.value }
    }

    fn of(&self, surface: usize) -> impl Iterator<Item = &FacetHits> {
        self.facets.iter().filter(move |facet| facet.surface == surface)
    }

    fn weighted(&self, weight: impl Fn(&FacetHits) -> f64) -> Bounded {
        self.facets
            .iter()
            .map(|facet| {
                let (all, weight) = (facet.from(1), weight(facet));
                Bounded { value: weight * all.value, error: weight * all.error }
            })
            .sum()
    }
}
