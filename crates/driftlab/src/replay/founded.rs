//! Whether the vertices that a log speaks of are founded in order, before memory is asked for them.

use formats::log::{Content, Decision, Stamp, Topic};

/// Counts the vertices of a log's graph while it is read.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Founded {
    known: u32,
    fault: Option<Fault>,
}

/// The first message that speaks of a vertex which cannot be there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fault {
    topic: usize,
    stamp: Stamp,
    vertex: u32,
    what: &'static str,
    /// The highest number that it could have had; `None` where there was no vertex at all.
    most: Option<u32>,
}

impl Founded {
    /// Takes a message: edges and standings found at most the next vertex, decisions none.
    pub fn take(&mut self, topic: usize, content: &Content) {
        match content {
            Content::Edge(edge) => {
                self.next(topic, edge.stamp, edge.a, "an edge from vertex");
                self.next(topic, edge.stamp, edge.b, "an edge to vertex");
            }
            Content::Standing(standing) => {
                self.next(topic, standing.stamp, standing.vertex, "a standing at vertex");
            }
            Content::Decision(message) => {
                if let Decision::GaveUp { vertex, .. } = message.decision
                    && vertex >= self.known
                {
                    let most = self.known.checked_sub(1);
                    let what = "a decision at vertex";
                    let fault = Fault { topic, stamp: message.stamp, vertex, what, most };
                    self.fault.get_or_insert(fault);
                }
            }
            _ => {}
        }
    }

    fn next(&mut self, topic: usize, stamp: Stamp, vertex: u32, what: &'static str) {
        if vertex > self.known {
            let most = Some(self.known);
            self.fault.get_or_insert(Fault { topic, stamp, vertex, what, most });
        } else if vertex == self.known {
            self.known += 1;
        }
    }

    /// What is wrong with the graph, with topic, time and number.
    pub fn fault(&self, topics: &[Topic]) -> Option<String> {
        let Fault { topic, stamp, vertex, what, most } = self.fault?;
        let name = topics.get(topic).map_or("a topic", |topic| topic.name.as_str());
        let expected = match most {
            Some(most) => format!("{most} at most: vertices are numbered as they come, from 0"),
            None => "an edge or a standing before it".to_owned(),
        };
        Some(format!("{name} at {stamp} s: found {what} {vertex}, expected {expected}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use formats::log::{DecisionMessage, EdgeMessage, StandingMessage};
    use pose::Se2;

    const STAMP: Stamp = Stamp::from_nanos(2_500_000_000);

    fn standing(vertex: u32) -> Content {
        let vertex_from_body = Se2::identity();
        Content::Standing(StandingMessage { stamp: STAMP, vertex, vertex_from_body })
    }

    fn edge(a: u32, b: u32) -> Content {
        let a_from_b = Se2::identity();
        Content::Edge(EdgeMessage { stamp: STAMP, a, b, place: false, a_from_b })
    }

    fn gave_up(vertex: u32) -> Content {
        let decision = Decision::GaveUp {
            vertex,
            vertex_from_body: Se2::identity(),
            goal_in_body: [1.0, 0.0],
            radius_m: 0.5,
            everywhere: true,
        };
        Content::Decision(DecisionMessage { stamp: STAMP, map: "grid".into(), decision })
    }

    fn fault(contents: &[Content]) -> Option<String> {
        let mut founded = Founded::default();
        contents.iter().for_each(|content| founded.take(0, content));
        founded.fault(&[Topic::new("/graph", "", "", None)])
    }

    #[test]
    fn vertices_come_in_order_or_are_told() {
        // A run begins with a standing, or with an edge.
        assert_eq!(fault(&[standing(0), edge(0, 1), standing(1), gave_up(1), edge(0, 2)]), None);
        assert_eq!(fault(&[edge(0, 1), edge(1, 2), standing(0), gave_up(2)]), None);
        for (contents, found) in [
            (vec![standing(4_000_000_000)], "a standing at vertex 4000000000, expected 0 at most"),
            (vec![edge(0, 2)], "an edge to vertex 2, expected 1 at most"),
            (vec![standing(0), edge(u32::MAX, 1)], "an edge from vertex 4294967295"),
            (vec![standing(0), gave_up(1)], "a decision at vertex 1, expected 0 at most"),
            (vec![gave_up(0)], "a decision at vertex 0, expected an edge or a standing before"),
            // The first one counts.
            (vec![standing(1), edge(0, 9)], "a standing at vertex 1"),
        ] {
            let told = fault(&contents).expect(found);
            assert!(told.starts_with("/graph at 2.500000000 s: found "), "{told}");
            assert!(told.contains(found), "{told}");
        }
    }
}
