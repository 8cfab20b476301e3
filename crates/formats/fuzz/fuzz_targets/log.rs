//! Any bytes as a recording: no panic, and what is told fits what was given.
#![no_main]

use formats::log::{LogReader, ReadOptions};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(mut reader) = LogReader::new(bytes, &ReadOptions::default()) else { return };
    let mut read = vec![0; 1 << 12];
    while let Some(message) = reader.next() {
        assert_eq!(reader.topics()[message.topic].kind, Some(message.content.kind()));
        read[message.topic] += 1;
    }
    for (topic, read) in reader.topics().iter().zip(read) {
        let refused = if topic.kind.is_some() { topic.refused } else { topic.messages };
        assert_eq!(topic.messages, read + refused);
    }
    assert!(reader.damage().is_none_or(|damage| damage.at <= bytes.len() as u64));
});
