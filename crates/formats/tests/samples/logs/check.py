"""Reads an MCAP file with readers that share no code with its writer, and tells what is in it.

Fails where the summary, the index and the stream disagree; where a definition or the bytes of a message are
not those of stock ROS 2; where a scan for ROS is not its exact copy in single precision; and, with
transforms in the file, where something is given in a frame that they do not lead to.
"""

import sys

import numpy
from mcap.reader import NonSeekingReader, make_reader
from mcap_protobuf.decoder import DecoderFactory as Protobuf
from mcap_ros2.decoder import DecoderFactory as Ros2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

FACTORIES = [Ros2(), Protobuf()]
STOCK = get_typestore(Stores.ROS2_HUMBLE)


def last(message):
    """A word about a message."""
    for name in ("ranges", "transforms", "entities", "data"):
        if hasattr(message, name):
            return f"{len(getattr(message, name))} {name}"
    return str(message).replace("\n", " ")[:60]


def frames_of(schema, message):
    """The frames that a message is given in, and the transforms that it tells."""
    if schema == "tf2_msgs/msg/TFMessage":
        return [], [(one.header.frame_id, one.child_frame_id) for one in message.transforms]
    if schema == "foxglove.SceneUpdate":
        return [entity.frame_id for entity in message.entities], []
    if hasattr(message, "header"):
        return [message.header.frame_id], []
    return ([message.frame_id] if hasattr(message, "frame_id") else []), []


def check_bytes(schema, data, decoded):
    """Stock ROS 2 must read the same from the bytes, and write the same bytes."""
    message = STOCK.deserialize_cdr(data, schema)
    assert bytes(STOCK.serialize_cdr(message, schema)) == bytes(data), f"{schema}: stock ROS writes other bytes"
    if schema == "sensor_msgs/msg/LaserScan":
        assert numpy.array_equal(message.ranges, numpy.float32(decoded.ranges), equal_nan=True)
    if schema == "nav_msgs/msg/Odometry":
        assert message.pose.pose.position.x == decoded.pose.pose.position.x


def main(path):
    counts, shown, scans, exact, used, parents = {}, {}, {}, {}, set(), {}
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=FACTORIES)
        statistics = reader.get_summary().statistics
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            key = (channel.topic, schema.name, channel.message_encoding)
            counts[key] = counts.get(key, 0) + 1
            shown[key] = last(decoded)
            frames, transforms = frames_of(schema.name, decoded)
            used.update(frames)
            parents.update((child, parent) for parent, child in transforms)
            if channel.message_encoding == "cdr":
                check_bytes(schema.name, message.data, decoded)
            if schema.name == "sensor_msgs/msg/LaserScan":
                scans.setdefault(channel.metadata.get("driftlab.copy_of"), []).append(decoded)
            if schema.name == "foxglove.LaserScan":
                exact.setdefault(channel.topic, []).append(decoded)
    with open(path, "rb") as file:
        streamed = sum(1 for _ in NonSeekingReader(file, validate_crcs=True).iter_messages())
    assert sum(counts.values()) == statistics.message_count, "the summary counts other messages"
    assert streamed == statistics.message_count, "the index leads to other messages"
    for key, count in sorted(counts.items()):
        print(f"{key[0]:24} {key[1]:32} {key[2]:9} {count:6}  {shown[key]}")

    # The definitions of ROS 2 must be those that another library knows by the same names.
    with open(path, "rb") as file:
        for schema in make_reader(file).get_summary().schemas.values():
            if schema.encoding == "ros2msg":
                for name, definition in get_types_from_msg(schema.data.decode(), schema.name).items():
                    assert definition[1] == STOCK.fielddefs[name][1], f"{name} has other fields"
                print(f"{schema.name}: as in ROS 2 Humble")

    for topic, copies in scans.items():
        if topic is not None:
            assert len(copies) == len(exact[topic]), f"{topic}: other scans than the copies for ROS"
            for copy, own in zip(copies, exact[topic]):
                assert numpy.array_equal(
                    numpy.float32(copy.ranges), numpy.float32(own.ranges), equal_nan=True)
                end = own.start_angle + copy.angle_increment * (len(own.ranges) - 1)
                assert abs(end - own.end_angle) < 1e-4 and abs(copy.angle_min - own.start_angle) < 1e-6
            print(f"{topic}: {len(copies)} scans, as for ROS up to single precision")

    if parents:
        def root(frame):
            for _ in range(len(parents) + 1):
                if frame not in parents:
                    return frame
                frame = parents[frame]
            raise AssertionError("transforms that go round in a circle")
        roots = {root(frame) for frame in used | set(parents) if frame}
        assert len(roots) == 1, f"frames that no transform connects: {sorted(roots)}"
        print(f"{len(used)} frames are used, {len(parents)} transforms lead to {roots.pop()}")


if __name__ == "__main__":
    main(sys.argv[1])
