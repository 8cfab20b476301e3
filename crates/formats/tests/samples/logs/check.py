"""Reads an MCAP file with readers that share no code with its writer, and tells what is in it."""

import sys

from mcap.reader import NonSeekingReader, make_reader
from mcap_protobuf.decoder import DecoderFactory as Protobuf
from mcap_ros2.decoder import DecoderFactory as Ros2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

FACTORIES = [Ros2(), Protobuf()]


def last(message):
    """A word about a message."""
    for name in ("ranges", "transforms", "entities", "data"):
        if hasattr(message, name):
            return f"{len(getattr(message, name))} {name}"
    return str(message).replace("\n", " ")[:60]


def main(path):
    counts, shown = {}, {}
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=FACTORIES)
        statistics = reader.get_summary().statistics
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            key = (channel.topic, schema.name, channel.message_encoding)
            counts[key] = counts.get(key, 0) + 1
            shown[key] = last(decoded)
    assert sum(counts.values()) == statistics.message_count, "the summary counts other messages"
    with open(path, "rb") as file:
        streamed = sum(1 for _ in NonSeekingReader(file, validate_crcs=True).iter_messages())
    assert streamed == statistics.message_count, "the index leads to other messages"
    for key, count in sorted(counts.items()):
        print(f"{key[0]:24} {key[1]:32} {key[2]:9} {count:6}  {shown[key]}")

    # The definitions of ROS 2 must be those that another library knows by the same names.
    known = get_typestore(Stores.ROS2_HUMBLE)
    with open(path, "rb") as file:
        for schema in make_reader(file).get_summary().schemas.values():
            if schema.encoding == "ros2msg":
                for name, definition in get_types_from_msg(schema.data.decode(), schema.name).items():
                    own = get_typestore(Stores.EMPTY)
                    assert definition[1] == known.FIELDDEFS[name][1], f"{name} has other fields"
                print(f"{schema.name}: as in ROS 2 Humble")


if __name__ == "__main__":
    main(sys.argv[1])
