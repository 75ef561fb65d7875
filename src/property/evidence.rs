//! Witnesses and certificates: a [`Statement`] and the [`Excerpt`] of matrix and mesh that it speaks of.
//!
//! Every `f64` is a rational number, so a statement about an excerpt is an exact statement, and
//! [`recheck`](super::recheck) decides it without trusting the checker that made it. What a statement needs beyond its
//! excerpt (that the excerpt was copied faithfully; a certificate that speaks of the whole matrix) is checked against the
//! operator itself.

mod forms;
mod fraction;
mod spectral;

pub use forms::{Exception, Term};
pub use fraction::Fraction;
pub use spectral::{Condition, Mesh, Weighting};

use serde::{Deserialize, Serialize};

/// A statement about an operator on a domain, with the part of both that it speaks of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// What is stated.
    pub statement: Statement,
    /// The part of matrix and mesh that decides it.
    #[serde(default, skip_serializing_if = "Excerpt::is_empty")]
    pub excerpt: Excerpt,
}

/// A part of a matrix and of a mesh, copied bit for bit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Excerpt {
    /// Whole rows of the stiffness matrix: every stored entry of each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rows: Vec<Row>,
    /// Whole rows of the mass matrix.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mass_rows: Vec<Row>,
    /// Positions of vertices.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub positions: Vec<(usize, [f64; 3])>,
    /// Faces with their corners. Where a statement speaks of the star of a vertex, all faces there.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub faces: Vec<(usize, Vec<usize>)>,
    /// Edges, where the domain has no faces. Where a statement speaks of the star of a vertex, all edges there.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edges: Vec<[usize; 2]>,
}

/// A row of a matrix: its number and all its stored entries, columns ascending.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The number of the row.
    pub row: usize,
    /// `(column, value)`.
    pub entries: Vec<(usize, f64)>,
}

impl Excerpt {
    /// Whether nothing is copied.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
            && self.mass_rows.is_empty()
            && self.positions.is_empty()
            && self.faces.is_empty()
            && self.edges.is_empty()
    }
}

/// Which of the two matrices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Which {
    /// `L`.
    Stiffness,
    /// `M`.
    Mass,
}

/// A corner opposite an edge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Corner {
    /// The vertex.
    pub vertex: usize,
    /// The angle there, in degrees, for a reader.
    pub angle_deg: f64,
}

/// A vector by its non-zero components.
pub type SparseVector = Vec<(usize, f64)>;

/// What a witness or certificate states. `ω_ij = −L_ij`; `B` is the set of boundary vertices, `I` the rest.
///
/// "Rows …" says which whole rows the excerpt carries. Where it says "all rows" they are carried while the matrix has at
/// most [`LARGEST_EXCERPT`] entries; above that the statement is checked against the operator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Statement {
    // ── witnesses ──────────────────────────────────────────────────────────────────────────────────────────────────
    /// FIN: the entry is NaN or infinite. Nothing else is excerpted (JSON has no such numbers).
    NotFinite {
        /// Which matrix.
        matrix: Which,
        /// Row.
        i: usize,
        /// Column.
        j: usize,
        /// "NaN", "inf" or "-inf".
        value: String,
    },
    /// LOC, and KER where the two belong to different components: `L_ij ≠ 0` although no face (no edge, on a graph) contains
    /// both. Row i; all faces or edges at i.
    FarEntry {
        /// Row.
        i: usize,
        /// Column.
        j: usize,
        /// Distance from i to j in rings, vertices of one face being neighbours; absent where they are not connected.
        rings: Option<usize>,
    },
    /// SYM: `|L_ij − L_ji| > threshold`. Rows i and j.
    Asymmetry {
        /// Row.
        i: usize,
        /// Column.
        j: usize,
        /// The threshold in force there.
        threshold: f64,
    },
    /// NULL: `|Σ_j L_ij| > threshold`. Row i.
    RowSum {
        /// Row.
        i: usize,
        /// The threshold in force there.
        threshold: f64,
    },
    /// KER: `|(Lx)_i| ≤ threshold·s_i` for every row, `s_i = Σ_k |L_ik|`, although `x` is not constant on the connected
    /// component of vertices `a` and `b`, where its values differ by at least 1. All rows.
    KernelVector {
        /// The vector.
        x: SparseVector,
        /// A vertex.
        a: usize,
        /// A vertex of the same component.
        b: usize,
        /// The threshold in force, relative to the row scale.
        threshold: f64,
    },
    /// POS, POS0: `ω_ij` is negative (`zero: false`) or zero (`zero: true`) on an edge. Row i, positions and faces at the edge.
    Weight {
        /// The smaller end of the edge; the larger one where only the weight of that direction is meant (L not symmetric).
        i: usize,
        /// The other end.
        j: usize,
        /// Whether the weight is zero rather than negative.
        zero: bool,
        /// The corners opposite the edge, on a triangle surface.
        opposite: Vec<Corner>,
    },
    /// PSD: `xᵀLx < 0`, exactly. Rows of the support of x.
    NegativeEnergy {
        /// The direction.
        x: SparseVector,
    },
    /// LIN, FLUX: `|Σ_j L_ij (x_j − x_i) − e| > threshold` for the coordinate `axis`. With `boundary: None` (LIN) `e = 0`; with
    /// `boundary: Some([p, q])`, the previous and next vertex along the boundary with the surface to the left, `e` is the
    /// component of `½ J (x_q − x_p)`, `J(a, b) = (b, −a)` in the plane of `axes`. Row i, positions of its stencil and of p, q.
    Moment {
        /// Row.
        i: usize,
        /// The coordinate: 0, 1 or 2.
        axis: usize,
        /// The two axes of the plane, positively oriented with the faces.
        axes: [usize; 2],
        /// Previous and next boundary vertex.
        boundary: Option<[usize; 2]>,
        /// The threshold in force there.
        threshold: f64,
    },
    /// ENERGY: the entry `(axis, other)` of `½ Σ_{i≠j} ω_ij (x_i − x_j)(x_i − x_j)ᵀ` (with `trace: true`, its trace) differs from the area (`twice` the area for
    /// the trace; 0 off the diagonal) by more than the threshold. All rows, positions, faces; `star` names the vertex
    /// whose row has the largest share.
    Energy {
        /// First coordinate.
        axis: usize,
        /// Second coordinate.
        other: usize,
        /// Whether the trace over the three coordinates is meant.
        trace: bool,
        /// The energy found.
        found: f64,
        /// What it should be.
        expected: f64,
        /// The threshold in force.
        threshold: f64,
        /// The vertex with the largest share.
        star: usize,
    },
    /// ACC: `|−L_ij − ½ Σ cot| > threshold`, the sum over the angles opposite the edge. Row i, faces at the edge with their corners.
    Inaccurate {
        /// Row.
        i: usize,
        /// Column.
        j: usize,
        /// The exact weight, rounded.
        exact: f64,
        /// How far `−L_ij` is off.
        error: f64,
        /// The threshold in force there.
        threshold: f64,
    },
    /// MAX-local: row i has a positive weight to `positive` and a negative weight to `negative`. Row i.
    BothSigns {
        /// Row.
        i: usize,
        /// Where `ω > 0`.
        positive: usize,
        /// Where `ω < 0`.
        negative: usize,
    },
    /// MAX-local: every weight of row i is zero. Row i.
    NoWeight {
        /// Row.
        i: usize,
    },
    /// MVP: in row i, `ω_ij / L_ii < 0` for this j; or, with `j = i`, `L_ii ≤ 0`. Row i.
    NotConvex {
        /// Row.
        i: usize,
        /// Column.
        j: usize,
    },
    /// MAX-global: the solution `u` of `(Lu)_k = 0` at every vertex k outside `set`, with `u = 1` at `source` and 0 on the rest
    /// of `set`, has `u_i < 0` (`low: true`) or `u_i > 1` (`low: false`). All rows outside `set`.
    Overshoot {
        /// The vertices where values are prescribed.
        set: Vec<usize>,
        /// The vertex of the set with value 1.
        source: usize,
        /// The vertex where the solution leaves [0, 1].
        at: usize,
        /// Its value there, approximately.
        value: f64,
        /// Whether it is below 0 rather than above 1.
        low: bool,
    },
    /// MAX-global: `(Lx)_k = 0` exactly for every vertex k outside `set` although `x ≠ 0` vanishes on `set`: the Dirichlet
    /// problem has no unique solution; or up to the rounding of the sum on the diagonal. All rows of the support's component.
    Singular {
        /// The vertices where values are prescribed.
        set: Vec<usize>,
        /// The vector.
        x: SparseVector,
    },
    /// MAX-heat: entry `(at, source)` of `(M + tL)⁻¹ M` is negative. All rows, all mass rows.
    HeatLoss {
        /// The time step.
        t: f64,
        /// Where the heat was.
        source: usize,
        /// Where the temperature falls below zero.
        at: usize,
        /// The value, approximately.
        value: f64,
    },
    /// MASS: the total `1ᵀM1` differs from the area by more than the threshold. All mass rows, positions, faces.
    MassTotal {
        /// The total found.
        found: f64,
        /// The area.
        expected: f64,
        /// The threshold in force.
        threshold: f64,
    },
    /// MASS: `|M_ij − M_ji| > threshold`. Mass rows i and j.
    MassAsymmetry {
        /// Row.
        i: usize,
        /// Column.
        j: usize,
        /// The threshold in force there.
        threshold: f64,
    },
    /// MASS: `xᵀMx ≤ 0` for a vector `x ≠ 0`. Mass rows of the support.
    MassNotPositive {
        /// The direction.
        x: SparseVector,
    },
    /// MASS: the share `Σ_j M_ij` of vertex i is outside `[lower, upper]`, the bounds that its star sets. Mass row i, all
    /// faces at i with their positions.
    MassShare {
        /// The vertex.
        i: usize,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// PERM, RIGID, SCALE, ISO, REACH, UNION: the entry `(i, j)` of the operator built on the transformed domain, brought back
    /// to the numbering and scale of the original, differs by more than the threshold.
    Changed {
        /// The transformation, in words that say how to repeat it.
        transformation: String,
        /// Which matrix.
        matrix: Which,
        /// Row.
        i: usize,
        /// Column.
        j: usize,
        /// The entry on the original domain.
        before: f64,
        /// The entry on the transformed domain.
        after: f64,
        /// The threshold in force.
        threshold: f64,
    },
    /// No property; the Cheeger inequality with the volume `Σ_{i,j∈A} ω_ij` as printed in the primer: of all partitions of a
    /// connected graph with positive weights the one into `side` and the rest has the smallest constant λ_C, and
    /// `xᵀLx < ½ λ_C² (xᵀDx − (1ᵀDx)²/1ᵀD1)`, D the degrees, so that `λ̃₁ < λ_C²/2`. All rows.
    BelowCheeger {
        /// The vector.
        x: SparseVector,
        /// One side of the partition that attains the constant.
        side: Vec<usize>,
    },
    // ── statements about a planar triangulation alone, of any weights that it could have ──────────────────────────
    /// The heights are strictly convex across every interior edge, and the weights (jump of the gradient over the length)
    /// are positive and in equilibrium, `Σ_j ω_ij (x_i − x_j) = 0`, at interior vertices: SYM, LOC, LIN and POS are possible at
    /// once. All positions and faces.
    Lift {
        /// The height of each vertex.
        heights: Vec<(usize, Fraction)>,
        /// The weight of each interior edge.
        weights: Vec<([usize; 2], Fraction)>,
    },
    /// The weights of all edges with an interior end are positive and in equilibrium at interior vertices: SYM, LOC, LIN and
    /// POS are possible at once. All positions and faces.
    Equilibrium {
        /// The weight of each of these edges.
        weights: Vec<([usize; 2], Fraction)>,
    },
    /// The motion y leaves the boundary in place, and `g_ij = (y_i − y_j)·(x_i − x_j)` is non-negative on every edge with an
    /// interior end and positive on one; since `Σ ω_ij g_ij = 0` in equilibrium, SYM, LOC, LIN and POS are impossible at once.
    /// All positions and faces.
    Motion {
        /// The vertices that move, all of them interior.
        motion: Vec<(usize, [Fraction; 2])>,
        /// The rate `g_ij` of each edge with an interior end.
        rates: Vec<([usize; 2], Fraction)>,
    },
    /// No heights lift each vertex named above the plane of the face named with it: with these multipliers, not negative and
    /// not all zero, the conditions `h_v [abc] − h_a [vbc] − h_b [avc] − h_c [abv] > 0` add up to `0 > 0`. All positions and faces.
    NoLift {
        /// Whether each vertex is the one opposite in a face beside: then no heights are even locally convex.
        beside: bool,
        /// Face, vertex and multiplier.
        multipliers: Vec<(usize, usize, Fraction)>,
    },
    // ── certificates ───────────────────────────────────────────────────────────────────────────────────────────────
    /// Every one of `checked` places was looked at and none violates the property; the worst is at `worst`.
    Scan {
        /// How many places.
        checked: usize,
        /// The place with the largest margin: a vertex `[i]` or a pair `[i, j]`.
        worst: Vec<usize>,
    },
    /// PSD: `L` is symmetric up to rounding with vanishing row sums and no negative weight, so
    /// `xᵀLx = ½ Σ ω_ij (x_i − x_j)² ≥ 0`.
    SumOfSquares,
    /// PSD: `½(L + Lᵀ)`, lifted by two thirds of `shift·diag(s)` or more, has only positive pivots, so that no eigenvalue relative to
    /// `diag(s)` is below `−shift`: the rounding of the factorisation is included in it.
    ShiftedFactor {
        /// The shift, relative to the row scales `s_i = Σ_k |L_ik|`.
        shift: f64,
        /// The smallest pivot relative to its row scale.
        smallest_pivot: f64,
    },
    /// KER: `L ± shift·diag(s)` have 0 and `kernel` negative pivots: exactly `kernel` eigenvalues relative to `diag(s)` lie in
    /// `(−shift, shift)`. Rows and columns without entries are left out of the factorisations and counted as kernel.
    InertiaCount {
        /// The shift.
        shift: f64,
        /// The dimension of the kernel.
        kernel: usize,
    },
    /// KER: no weight is negative and row sums vanish up to rounding, so that −L generates a random walk; its harmonic
    /// functions are as many as its closed classes: classes of vertices that lead to each other along positive weights
    /// (i leads to j where `ω_ij > 0`) and to no other vertex. There are `kernel` of them, an empty row counting as one.
    ClosedClasses {
        /// The dimension of the kernel.
        kernel: usize,
    },
    /// KER: of `diag(s)^(−½) L diag(s)^(−½)`, s the larger of the absolute sums of a row and its column (1 where both are empty), the
    /// smallest singular value that is not of the kernel, and the largest that is, relative to the largest.
    SingularValues {
        /// The dimension of the kernel.
        kernel: usize,
        /// The largest singular value counted as zero.
        zero: f64,
        /// The smallest one that is not.
        positive: f64,
    },
    /// MAX-global: no interior row has a negative weight, and from every interior vertex a chain of positive weights leads to
    /// the set: `L_II` is an M-matrix. Where the domain is closed, from every vertex of a component to every other one, so
    /// that the same is true of every set that meets each component; `set` is then that of the largest set drawn.
    /// MAX-heat: with `set: 0`; no row has a negative weight, the mass is lumped and positive, and no row sum of L is below zero by
    /// more than rounding, or by what its mass outweighs for each t stated: `M + tL` is an M-matrix.
    SignPattern {
        /// How many vertices have prescribed values.
        set: usize,
    },
    /// MAX-global, MAX-heat: all `columns` of the solution were computed; the smallest entry is `smallest`, the error of each
    /// entry at most `error`.
    Solved {
        /// How many right-hand sides.
        columns: usize,
        /// The smallest entry found.
        smallest: f64,
        /// The bound on its error.
        error: f64,
    },
    /// A relation between constructions: `entries` entries were compared, the worst differs by `worst` thresholds.
    Compared {
        /// The transformations, in words.
        transformations: Vec<String>,
        /// How many entries.
        entries: usize,
    },
    // ── about triangulations, decided by what is written down and nothing else ─────────────────────────────────────
    /// Rippa in the plane. From the faces of the excerpt, a triangulation of the convex hull of its positions (whole numbers), the
    /// flips lead one after the other to the Delaunay triangulation `end`; the cotangent stiffness falls with each by `κ w wᵀ`,
    /// κ > 0, and altogether by their sum: `L_T − L_D = Σ κ w wᵀ`. All positions, all faces.
    FlipsToDelaunay {
        /// The flips in their order.
        flips: Vec<Flip>,
        /// The faces at the end.
        end: Vec<[usize; 3]>,
        /// A function by its values at the vertices, whole numbers.
        values: Vec<f64>,
        /// Its Dirichlet energy `½ uᵀLu` before the first flip and after each, rounded to the nearest `f64`.
        energies: Vec<f64>,
    },
    /// Rippa in space (a witness against it): of the two triangulations of five points of the excerpt (whole numbers) the one
    /// named `delaunay` is the only Delaunay triangulation, and a function has more Dirichlet energy on it than on `other`.
    DelaunayNotMinimal {
        /// The tetrahedra of the Delaunay triangulation.
        delaunay: Vec<[usize; 4]>,
        /// The tetrahedra of the other triangulation.
        other: Vec<[usize; 4]>,
        /// The function by its values at the vertices, whole numbers.
        values: Vec<f64>,
        /// Its energies `½ ∫ |∇u|²` on the two, exactly: `p/q` in lowest terms.
        energies: [String; 2],
    },
    /// MAX-global with a negative weight: the cotangent weight of the edge (i, j), with an end inside, is negative on the
    /// triangulation of a simple polygon in the excerpt (whole numbers as positions, all faces), and yet every entry of the
    /// harmonic extension `−L_II⁻¹ L_IB` from the boundary B is at least `smallest` > 0.
    PositiveExtension {
        /// One end.
        i: usize,
        /// The other end.
        j: usize,
        /// The weight, exactly: `p/q` in lowest terms.
        weight: String,
        /// The smallest entry, exactly. All rows, rounded to the nearest `f64`.
        smallest: String,
    },
    /// Tutte (a witness against it without one of its hypotheses): `Σ_j ω_ij (x_j − x_i) = 0` exactly at every vertex that is
    /// not on the `boundary`, a polygon, and the drawing is no embedding. Every hypothesis but `missing` holds, and that one
    /// does not. All faces, where the graph is that of a triangulation.
    NotEmbedded {
        /// The boundary cycle, counter-clockwise around its area.
        boundary: Vec<usize>,
        /// The edges that have an end inside, with their weights, whole numbers.
        weights: Vec<(usize, usize, f64)>,
        /// The positions of the vertices, exactly: `p/q` in lowest terms.
        drawing: Vec<[String; 2]>,
        /// `Σ k (|e_k|² + ω_k)` over all edges e₁, e₂, … in lexicographic order, those of the polygon and of the faces included,
        /// ω = 0 where none is given, exactly: every position and weight takes part in it, so that none can be changed alone.
        checksum: String,
        /// The hypothesis that is missing.
        missing: Hypothesis,
        /// What is wrong with the drawing.
        fault: Fault,
    },
    /// Flips of a triangulation of the flat torus ℝ²/ℤ² with one vertex, whose edges are the two vectors of `start`, a basis of
    /// ℤ², and their sum: it takes exactly `flips` flips, each of them forced, to the Delaunay triangulation with the edges
    /// `end` and their sum.
    TorusFlips {
        /// Two edges of the triangulation.
        start: [[i64; 2]; 2],
        /// How many flips.
        flips: usize,
        /// Two edges of the Delaunay triangulation.
        end: [[i64; 2]; 2],
    },
    // ── about spectra, decided by what is written down and nothing else ────────────────────────────────────────────
    /// Two graphs with unit weights are not isomorphic, and their Laplacians have the same characteristic polynomial: `det(xI − L)`, or
    /// with `normalised` `det(xI − D⁻¹L)`, D the degrees.
    Cospectral {
        /// How many vertices each has.
        vertices: usize,
        /// The edges of one.
        first: Vec<[usize; 2]>,
        /// The edges of the other.
        second: Vec<[usize; 2]>,
        /// Whether the random walk's Laplacian is meant.
        normalised: bool,
        /// The coefficients of the polynomial, ascending.
        polynomial: Vec<Fraction>,
    },
    /// Two simple polygons, triangulated, are not congruent, and their eigenvalue problems are the same one: with R invertible,
    /// `X_B R = S X_A` for the cotangent stiffness, the barycentric and the consistent mass X. Under Dirichlet S is R, and `X = I`
    /// fits as well, so that the stiffness alone has one spectrum.
    Transplantation {
        /// The mesh A.
        first: Mesh,
        /// The mesh B.
        second: Mesh,
        /// What eigenfunctions do at the boundary.
        condition: Condition,
        /// The entries of R that are not zero: vertex of B, vertex of A.
        matrix: Vec<(usize, usize, Fraction)>,
        /// The entries of S that are not zero.
        dual: Vec<(usize, usize, Fraction)>,
        /// The squared lengths of the sides of both polygons in their order, wherever that starts: no congruence takes one to the other.
        outlines: [Vec<u64>; 2],
    },
    /// A witness against isospectrality: the cotangent eigenvalue problems of two triangulated simple polygons have different numbers of
    /// eigenvalues below `sigma`.
    SpectraDiffer {
        /// One mesh.
        first: Mesh,
        /// The other mesh.
        second: Mesh,
        /// What eigenfunctions do at the boundary.
        condition: Condition,
        /// The mass.
        mass: Weighting,
        /// σ, exactly: `p/q` in lowest terms.
        sigma: Fraction,
        /// How many eigenvalues lie below σ, of each.
        below: [usize; 2],
        /// `det(L − σM)` of each, exactly.
        determinants: [Fraction; 2],
    },
    /// A witness against Rippa's theorem for eigenvalues: the faces of the excerpt (whole numbers as positions) are the only
    /// Delaunay triangulation, and its eigenvalue problem has fewer eigenvalues below `sigma` than that of the triangulation `other` of
    /// the same points: one of its eigenvalues is larger. All positions, all faces.
    DelaunayEigenvalue {
        /// The faces of the other triangulation.
        other: Vec<[usize; 3]>,
        /// What eigenfunctions do at the boundary.
        condition: Condition,
        /// The mass.
        mass: Weighting,
        /// σ, exactly: `p/q` in lowest terms.
        sigma: Fraction,
        /// How many eigenvalues lie below σ, on the Delaunay triangulation and on the other one.
        below: [usize; 2],
        /// `det(L − σM)` on both, exactly.
        determinants: [Fraction; 2],
    },
    // ── about smooth forms, decided by what is written down and nothing else ───────────────────────────────────────
    /// A witness against what is said of harmonic forms, and true of them on closed manifolds only, or of strict extrema only: the
    /// form α with polynomial coefficients is harmonic, `Δα = (dd* + d*d)α = 0` in orthonormal coordinates, and an exception.
    HarmonicForm {
        /// How many coordinates.
        dimension: usize,
        /// α, all its terms; not zero, of one degree.
        form: Vec<Term>,
        /// To what.
        exception: Exception,
    },
}

/// A flip: the counter-clockwise quadrilateral `a, b, c, d` loses its diagonal `ac` and gets `bd`.
///
/// With `[xyz]` twice the area of a triangle and `w = ([bcd], −[acd], [abd], −[abc])`, the affine dependency of the corners,
/// `L_before − L_after = κ w wᵀ`, `κ = incircle(a, b, c, d) / (2 [abc] [acd] [abd] [bcd])`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flip {
    /// The corners a, b, c, d.
    pub quad: [usize; 4],
    /// κ, exactly: `p/q` in lowest terms.
    pub kappa: String,
}

/// The hypotheses of Tutte's theorem for the drawing of a triangulated disc or of a planar graph. Where nothing else is missing
/// the boundary polygon is strictly convex, so that none of its sides has three vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Hypothesis {
    /// The boundary polygon is convex. (Where it is missing, no inner edge joins two vertices of the boundary.)
    ConvexBoundary,
    /// Every weight is positive.
    PositiveWeights,
    /// No edge inside joins two vertices of one side of the polygon.
    NoChordOnASide,
    /// The faces form a disc.
    Disc,
    /// The graph, given without faces, is 3-connected. (Where it is missing, there are at most four vertices, so that the
    /// graph is planar and a triangle of it bounds a face.)
    ThreeConnected,
}

/// What is wrong with a drawing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "fault", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Fault {
    /// This face of the excerpt is not drawn counter-clockwise, as its neighbours' boundary demands.
    Face {
        /// Its number.
        face: usize,
    },
    /// The ends of this edge are drawn at the same place.
    Edge {
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
    },
    /// The areas of the drawn faces add up to more than the polygon's, so that two of them overlap.
    Overlap {
        /// Twice the sum of the areas, exactly.
        faces: String,
        /// Twice the area of the polygon, exactly.
        polygon: String,
    },
}

/// The largest number of matrix entries that a statement about all rows carries with it.
pub const LARGEST_EXCERPT: usize = 120;

impl Evidence {
    /// A statement with an excerpt.
    pub fn new(statement: Statement, excerpt: Excerpt) -> Self {
        Evidence { statement, excerpt }
    }

    /// A statement that needs none.
    pub fn bare(statement: Statement) -> Self {
        Evidence { statement, excerpt: Excerpt::default() }
    }
}
