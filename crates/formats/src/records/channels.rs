//! The channels of a recorded file, and what their messages say.

use std::collections::BTreeMap;

use crate::log::{Damage, Message, Stamp, Topic};
use crate::messages::{Decoder, Frames};

/// The most topics of a file.
const MAX_TOPICS: usize = 1 << 12;

/// The longest name of a topic or a type, bytes.
const MAX_NAME: usize = 1 << 10;

/// The most warnings that are told one by one.
const MAX_WARNINGS: usize = 64;

/// One channel.
#[derive(Clone, Debug)]
struct Channel {
    topic: usize,
    decoder: Option<Decoder>,
}

/// What a file says about a channel.
pub(crate) struct NewChannel<'a> {
    pub topic: &'a str,
    pub schema: &'a str,
    pub encoding: &'a str,
    pub metadata: &'a BTreeMap<String, String>,
}

/// The channels of a file by their numbers, and the topics that they belong to.
#[derive(Debug)]
pub(crate) struct Channels {
    pub topics: Vec<Topic>,
    pub warnings: Vec<String>,
    pub damage: Option<Damage>,
    channels: Vec<Option<Channel>>,
    frames: Frames,
    units_per_metre: f64,
}

impl Channels {
    pub(crate) fn new(units_per_metre: f64) -> Self {
        Self {
            topics: Vec::new(),
            warnings: Vec::new(),
            damage: None,
            channels: Vec::new(),
            frames: Frames::default(),
            units_per_metre,
        }
    }

    /// Adds a channel; one with the number of another takes its place.
    pub(crate) fn add(&mut self, id: u16, new: &NewChannel<'_>) -> Result<(), String> {
        let names = [new.topic, new.schema, new.encoding];
        if let Some(long) = names.iter().find(|name| name.len() > MAX_NAME) {
            return Err(format!("a name of {} bytes, at most {MAX_NAME} are read", long.len()));
        }
        let decoder = Decoder::of(new.schema, new.encoding, new.metadata);
        let copy_of = Decoder::copy_of(new.metadata);
        let same = |topic: &Topic| {
            topic.name == new.topic && topic.schema == new.schema && topic.encoding == new.encoding
        };
        let topic = match self.topics.iter().position(same) {
            Some(topic) => topic,
            None if self.topics.len() == MAX_TOPICS => {
                return Err(format!("more than {MAX_TOPICS} topics"));
            }
            None => {
                let kind = decoder.as_ref().map(Decoder::kind);
                let mut topic = Topic::new(new.topic, new.schema, new.encoding, kind);
                topic.copy_of = copy_of.map(str::to_owned);
                self.topics.push(topic);
                self.topics.len() - 1
            }
        };
        let index = usize::from(id);
        if self.channels.len() <= index {
            self.channels.resize(index + 1, None);
        }
        self.channels[index] = Some(Channel { topic, decoder });
        Ok(())
    }

    /// Whether there is a channel of this number.
    pub(crate) fn has(&self, id: u16) -> bool {
        self.channels.get(usize::from(id)).is_some_and(Option::is_some)
    }

    /// Counts a message and reads it, where it can be read; `at` is its place for a warning.
    pub(crate) fn message(
        &mut self,
        id: u16,
        logged: Stamp,
        bytes: &[u8],
        at: impl FnOnce(usize) -> String,
    ) -> Result<Option<Message>, String> {
        let Some(Some(channel)) = self.channels.get(usize::from(id)) else {
            return Err(format!("a message of channel {id}, which was not named before"));
        };
        let topic = &mut self.topics[channel.topic];
        topic.count(logged);
        let Some(decoder) = &channel.decoder else { return Ok(None) };
        match decoder.decode(bytes, &mut self.frames, self.units_per_metre) {
            Ok(content) => Ok(Some(Message { topic: channel.topic, logged, content })),
            Err(malformed) => {
                topic.refused += 1;
                if topic.refused == 1 {
                    let (name, place) = (topic.name.clone(), at(malformed.at));
                    self.warn(format!(
                        "{place}: a message of {name}: {}; left out",
                        malformed.found
                    ));
                }
                Ok(None)
            }
        }
    }

    /// Notes something odd.
    pub(crate) fn warn(&mut self, what: String) {
        if self.warnings.len() < MAX_WARNINGS {
            self.warnings.push(what);
        }
    }

    /// Notes that nothing from `at` on was read.
    pub(crate) fn damaged(&mut self, at: u64, what: impl Into<String>) {
        self.damage.get_or_insert_with(|| Damage { at, what: what.into() });
    }
}
