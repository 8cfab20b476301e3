//! This project's own messages, as protocol buffers.

use nalgebra::{UnitComplex, Vector2};
use pose::Se2;

use super::Malformed;
use super::foxglove_proto::{each, numbers, stamp};
use super::proto::{Field, Fields};
use crate::log::{Decision, DecisionMessage, EdgeMessage, Stamp, StandingMessage};

/// A planar pose from x, y, cosine and sine, as they are in memory.
fn exact(xy: [f64; 4], at: usize) -> Result<Se2, Malformed> {
    let [x_m, y_m, cos, sin] = xy;
    let unit = (cos * cos + sin * sin - 1.0).abs() < 1e-9;
    if !(x_m.is_finite() && y_m.is_finite() && unit) {
        return Err(Malformed { at, found: "a pose that is no pose" });
    }
    let rotation = UnitComplex::new_unchecked(nalgebra::Complex::new(cos, sin));
    Ok(Se2 { rotation, translation: Vector2::new(x_m, y_m) })
}

/// `driftlab.Edge`.
pub(super) fn edge(bytes: &[u8]) -> Result<EdgeMessage, Malformed> {
    let (mut at, mut a, mut b, mut place) = (Stamp::default(), 0, 0, false);
    let mut xy = [0.0, 0.0, 1.0, 0.0];
    each(Fields::new(bytes), |field| {
        match field.number {
            1 => at = stamp(&field)?,
            2 => a = vertex(&field)?,
            3 => b = vertex(&field)?,
            4 => place = field.varint()? != 0,
            5 => xy = numbers(&field)?,
            _ => {}
        }
        Ok(())
    })?;
    Ok(EdgeMessage { stamp: at, a, b, place, a_from_b: exact(xy, 0)? })
}

/// `driftlab.Standing`.
pub(super) fn standing(bytes: &[u8]) -> Result<StandingMessage, Malformed> {
    let (mut at, mut id) = (Stamp::default(), 0);
    let mut xy = [0.0, 0.0, 1.0, 0.0];
    each(Fields::new(bytes), |field| {
        match field.number {
            1 => at = stamp(&field)?,
            2 => id = vertex(&field)?,
            3 => xy = numbers(&field)?,
            _ => {}
        }
        Ok(())
    })?;
    Ok(StandingMessage { stamp: at, vertex: id, vertex_from_body: exact(xy, 0)? })
}

/// `driftlab.Decision`.
pub(super) fn decision(bytes: &[u8]) -> Result<DecisionMessage, Malformed> {
    let (mut at, mut map, mut id) = (Stamp::default(), "", 0);
    let mut xy = [0.0, 0.0, 1.0, 0.0];
    let (mut goal_in_body, mut radius_m) = ([0.0; 2], 0.0);
    let (mut everywhere, mut looked_again) = (false, false);
    each(Fields::new(bytes), |field| {
        match field.number {
            1 => at = stamp(&field)?,
            2 => map = field.text()?,
            3 => id = vertex(&field)?,
            4 => xy = numbers(&field)?,
            5 => goal_in_body = numbers(&field)?,
            6 => radius_m = field.double()?,
            7 => everywhere = field.varint()? != 0,
            8 => looked_again = field.varint()? != 0,
            _ => {}
        }
        Ok(())
    })?;
    let vertex_from_body = exact(xy, 0)?;
    if !(goal_in_body.iter().all(|x| x.is_finite()) && radius_m.is_finite()) {
        return Err(Malformed { at: 0, found: "a goal that is not finite" });
    }
    let gave_up =
        Decision::GaveUp { vertex: id, vertex_from_body, goal_in_body, radius_m, everywhere };
    let decision = if looked_again { Decision::LookedAgain } else { gave_up };
    Ok(DecisionMessage { stamp: at, map: map.into(), decision })
}

fn vertex(field: &Field<'_>) -> Result<u32, Malformed> {
    u32::try_from(field.varint()?).or_else(|_| field.malformed("a vertex beyond 32 bits"))
}
