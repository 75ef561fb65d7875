//! Every construction of the catalogue with every word its parameters admit, and constructions with a planted defect.

use std::collections::BTreeMap;

use lapjury::domain::Domain;
use lapjury::laplacian::{self, Laplacian};
use lapjury::linalg::Csr;
use lapjury::operator::{Mass, MassKind, Operator, Provenance};
use lapjury::parameter::Range;

/// Something that makes operators: an entry of the catalogue with settings, or a defect planted in one.
pub struct Maker {
    pub label: String,
    pub entry: Option<&'static Laplacian>,
    pub settings: BTreeMap<String, String>,
    defect: Option<Defect>,
}

type Defect = fn(&Domain, Operator) -> Operator;

impl Maker {
    /// The operator on a domain, or the refusal in words.
    pub fn build(&self, domain: &Domain) -> Result<Operator, String> {
        let entry = self.entry.unwrap_or_else(host);
        let operator = entry.build(domain, &self.settings).map_err(|refusal| refusal.to_string())?;
        Ok(match self.defect {
            Some(defect) => defect(domain, operator),
            None => operator,
        })
    }
}

/// The entry that defects are planted in.
fn host() -> &'static Laplacian {
    laplacian::find("cotan").unwrap()
}

fn of(entry: &'static Laplacian, settings: &[(&str, String)]) -> Maker {
    let settings: BTreeMap<String, String> = settings.iter().map(|(k, v)| (k.to_string(), v.clone())).collect();
    let words: Vec<String> = settings.iter().map(|(k, v)| format!("{k}={v}")).collect();
    Maker { label: format!("{} {}", entry.id, words.join(" ")), entry: Some(entry), settings, defect: None }
}

/// Every entry with its defaults, and with every other value of one parameter at a time; of numbers both ends and the middle.
pub fn catalogue() -> Vec<Maker> {
    let mut makers = Vec::new();
    for &entry in laplacian::ALL {
        makers.push(of(entry, &[]));
        for parameter in entry.parameters {
            let values: Vec<String> = match parameter.range {
                Range::Choice(words) => words.iter().map(|w| w.to_string()).collect(),
                Range::Number(low, high) => [low, 0.5 * (low + high), high].map(|x| x.to_string()).to_vec(),
                Range::Whole(low, high) => [low, high].map(|x| x.to_string()).to_vec(),
                Range::Form(..) => vec![parameter.default.to_string()],
            };
            let others = values.into_iter().filter(|v| v != parameter.default);
            makers.extend(others.map(|value| of(entry, &[(parameter.name, value)])));
        }
    }
    let both = |weights: &str| [("form", "random-walk".to_string()), ("weights", weights.to_string())];
    let walk = laplacian::find("normalized-graph").unwrap();
    makers.extend(["given", "inverse-length"].map(|weights| of(walk, &both(weights))));
    makers
}

/// The stiffness with entries replaced; the mass and the declared signs stay.
fn with_entries(operator: Operator, changes: &[(usize, usize, f64)]) -> Operator {
    let n = operator.size();
    let kept = operator.stiffness().entries().filter(|&(i, j, _)| changes.iter().all(|c| (c.0, c.1) != (i, j)));
    let triplets: Vec<_> = kept.map(|(i, j, v)| (i, j, *v)).chain(changes.iter().copied()).collect();
    replaced(&operator, Csr::from_triplets(n, n, &triplets))
}

fn replaced(operator: &Operator, stiffness: Csr) -> Operator {
    let mass = operator.mass().unwrap().clone();
    Operator::new(stiffness, Provenance::default()).unwrap().with_mass(mass).unwrap()
}

fn scaled(operator: &Operator, factor: impl Fn(usize, usize) -> f64) -> Operator {
    replaced(operator, operator.stiffness().map(|i, j, v| factor(i, j) * v))
}

fn position(domain: &Domain, vertex: usize) -> [f64; 3] {
    domain.positions().map_or([0.0; 3], |p| p[vertex])
}

/// The cotangent Laplacian with one defect each: what no entry of the catalogue gets wrong.
pub fn defective() -> Vec<Maker> {
    let defects: [(&str, Defect); 11] = [
        ("an entry that is not a number", |_, o| match o.size() {
            0 => o,
            _ => with_entries(o, &[(0, 0, f64::NAN)]),
        }),
        ("an infinite mass", |_, o| {
            let mut mass = o.mass().unwrap().diagonal();
            mass.iter_mut().take(1).for_each(|m| *m = f64::INFINITY);
            o.with_mass(Mass::lumped(MassKind::Given, &mass)).unwrap()
        }),
        ("a doubled diagonal", |_, o| scaled(&o, |i, j| if i == j { 2.0 } else { 1.0 })),
        ("the other sign", |_, o| scaled(&o, |_, _| -1.0)),
        ("no entry at all", |_, o| replaced(&o, Csr::from_triplets(o.size(), o.size(), &[]))),
        ("weights that grow with the number of a vertex", |_, o| scaled(&o, |i, j| 1.0 + (i + j) as f64)),
        ("weights that depend on where a vertex lies", |d, o| {
            let x: Vec<f64> = (0..o.size()).map(|v| position(d, v)[0]).collect();
            let size = x.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
            scaled(&o, |i, j| 1.0 + ((x[i] + x[j]) / size).powi(2))
        }),
        ("weights that depend on the height", |d, o| {
            let extent = |axis: usize| {
                let range = (0..o.size()).map(|v| position(d, v)[axis]);
                range.clone().fold(f64::MIN, f64::max) - range.fold(f64::MAX, f64::min)
            };
            // The volume of the bounding box over the cube of its girth: zero exactly where the mesh lies flat.
            let girth = extent(0) + extent(1) + extent(2);
            let bulk = if o.size() > 0 && girth > 0.0 { (0..3).map(|a| extent(a) / girth).product() } else { 0.0 };
            scaled(&o, |_, _| 1.0 + bulk)
        }),
        ("weights that depend on the number of vertices", |_, o| {
            let n = o.size() as f64;
            scaled(&o, |_, _| n)
        }),
        ("weights in single precision", |_, o| {
            let single = o.stiffness().map(|_, _, v| f64::from(*v as f32));
            replaced(&o, single)
        }),
        ("one vertex that is heavier than its star", |_, o| {
            let mut mass = o.mass().unwrap().diagonal();
            mass.iter_mut().take(1).for_each(|m| *m *= 4.0);
            o.with_mass(Mass::lumped(MassKind::Given, &mass)).unwrap()
        }),
    ];
    let maker = |(label, defect): (&str, Defect)| Maker {
        label: format!("cotan with {label}"),
        entry: None,
        settings: BTreeMap::new(),
        defect: Some(defect),
    };
    defects.into_iter().map(maker).collect()
}
