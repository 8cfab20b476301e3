//! Poses as a rotation matrix beside a translation.

use pose::nalgebra::{
    Matrix2, Matrix3, Rotation3, SMatrix, UnitComplex, UnitQuaternion, Vector2, Vector3,
};
use pose::{Se2, Se3, So3};

use crate::factors::Manifold;

/// `[R t]` by columns: column `k` of the rotation for `k < d`, then the translation; entries beyond
/// `d` are 0.
pub type Columns = [[f64; 3]; 4];

/// Poses that embed into matrices: what chordal distances are measured on.
pub trait Rigid<const D: usize>: Manifold<D> {
    /// Dimension `d` of the space that the poses move: 2 or 3.
    const DIM: usize;

    /// `[R t]` by columns.
    fn columns(&self) -> Columns;

    /// The pose with this rotation and translation; the rotation must be one to rounding.
    fn from_columns(columns: &Columns) -> Self;

    /// The turn from one pose to another as a rotation vector in the frame of the map, radians.
    fn turn_between(from: &Self, to: &Self) -> Vector3<f64>;

    /// The covariance `tr(Ω⁻¹)` of an isotropic stand-in: traces of the inverse of the translation
    /// block and of the rotation block of an information matrix, where they can be inverted.
    fn inverse_traces(information: &SMatrix<f64, D, D>) -> (Option<f64>, Option<f64>);
}

impl Rigid<3> for Se2 {
    const DIM: usize = 2;

    fn columns(&self) -> Columns {
        let (c, s) = (self.rotation.re, self.rotation.im);
        let t = self.translation;
        [[c, s, 0.0], [-s, c, 0.0], [t.x, t.y, 0.0], [0.0; 3]]
    }

    fn from_columns(columns: &Columns) -> Self {
        let [[c, s, _], _, [x, y, _], _] = *columns;
        Self {
            rotation: UnitComplex::from_cos_sin_unchecked(c, s),
            translation: Vector2::new(x, y),
        }
    }

    fn turn_between(from: &Self, to: &Self) -> Vector3<f64> {
        Vector3::new(0.0, 0.0, (from.rotation.inverse() * to.rotation).angle())
    }

    fn inverse_traces(information: &SMatrix<f64, 3, 3>) -> (Option<f64>, Option<f64>) {
        let block: Matrix2<f64> = information.fixed_view::<2, 2>(0, 0).into_owned();
        let angle = information[(2, 2)];
        (block.try_inverse().map(|inverse| inverse.trace()), (angle != 0.0).then(|| 1.0 / angle))
    }
}

impl Rigid<6> for Se3 {
    const DIM: usize = 3;

    fn columns(&self) -> Columns {
        let r = self.rotation_matrix();
        let column = |k: usize| [r[(0, k)], r[(1, k)], r[(2, k)]];
        let t = self.translation;
        [column(0), column(1), column(2), [t.x, t.y, t.z]]
    }

    fn from_columns(columns: &Columns) -> Self {
        let r = Matrix3::from_fn(|row, column| columns[column][row]);
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(r));
        Self { rotation, translation: columns[3].into() }
    }

    fn turn_between(from: &Self, to: &Self) -> Vector3<f64> {
        So3::log(&(to.rotation * from.rotation.inverse()))
    }

    fn inverse_traces(information: &SMatrix<f64, 6, 6>) -> (Option<f64>, Option<f64>) {
        let trace = |offset: usize| {
            let block: Matrix3<f64> = information.fixed_view::<3, 3>(offset, offset).into_owned();
            block.try_inverse().map(|inverse| inverse.trace())
        };
        (trace(0), trace(3))
    }
}
