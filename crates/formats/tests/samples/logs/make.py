"""Writes the samples of this folder with writers that share no code with the readers under test.

    python3 -m venv v
    v/bin/pip install mcap mcap-protobuf-support foxglove-schemas-protobuf rosbags lz4 zstandard
    v/bin/python make.py
"""

import base64
import json
import math
import struct
from pathlib import Path

import numpy
from foxglove_schemas_protobuf import (
    CameraCalibration_pb2, FrameTransform_pb2, FrameTransforms_pb2, LaserScan_pb2, PackedElementField_pb2,
    PointCloud_pb2, PoseInFrame_pb2, RawImage_pb2,
)
from mcap.writer import CompressionType, IndexType, Writer
from mcap_protobuf.writer import Writer as ProtobufWriter
from rosbags.rosbag1 import Writer as BagWriter
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

HALF = math.sqrt(0.5)
RANGES = [1.0, 2.5, math.inf, 0.25, 7.75]
POINTS = numpy.array([[1, 2, 3], [-1.5, 0.25, 9]], dtype="<f4")
LEVELS = numpy.array([[0, 1000, 2000], [500, 65535, 1]], dtype="<u2")
METRES = numpy.array([[0.5, math.nan, 2.0]], dtype="<f4")
FX, FY, CX, CY = 500.0, 510.0, 1.5, 0.5
K = [FX, 0, CX, 0, FY, CY, 0, 0, 1]
P = [FX, 0, CX, 0, 0, FY, CY, 0, 0, 0, 1, 0]
STAMPS = [(1_700_000_000, 250_000_000), (1_700_000_001, 750_000_000)]


def foxglove_dicts(secs, nanos):
    """Topics, schemas and messages as dictionaries."""
    time = {"sec": secs, "nsec": nanos}
    pose = {"position": {"x": 1, "y": -2, "z": 0.5}, "orientation": {"x": 0, "y": 0, "z": HALF, "w": HALF}}
    here = {"position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}
    transform = {
        "timestamp": time, "parent_frame_id": "odom", "child_frame_id": "body",
        "translation": {"x": 1, "y": -2, "z": 0.5}, "rotation": {"x": 0, "y": 0, "z": HALF, "w": HALF},
    }
    fields = [{"name": name, "offset": 4 * at, "type": 7} for at, name in enumerate("xyz")]
    image = {"timestamp": time, "frame_id": "camera", "width": 3, "height": 2, "encoding": "16UC1", "step": 6}
    return [
        ("/scan", "foxglove.LaserScan", {
            "timestamp": time, "frame_id": "laser", "pose": here, "start_angle": -1.0, "end_angle": 1.0,
            "ranges": RANGES, "intensities": []}),
        ("/points", "foxglove.PointCloud", {
            "timestamp": time, "frame_id": "laser", "pose": pose, "point_stride": 12, "fields": fields,
            "data": POINTS.tobytes()}),
        ("/depth", "foxglove.RawImage", image | {"data": LEVELS.tobytes()}),
        ("/camera", "foxglove.CameraCalibration", {
            "timestamp": time, "frame_id": "camera", "width": 3, "height": 2, "distortion_model": "plumb_bob",
            "D": [0.1, 0, 0, 0, 0], "K": K, "R": [1, 0, 0, 0, 1, 0, 0, 0, 1], "P": P}),
        ("/tf", "foxglove.FrameTransform", transform),
        ("/tfs", "foxglove.FrameTransforms", {"transforms": [transform, transform]}),
        ("/pose", "foxglove.PoseInFrame", {"timestamp": time, "frame_id": "map", "pose": pose}),
        ("/other", "foxglove.Log", {"timestamp": time, "level": 1, "message": "hello \u00e9 \"quoted\""}),
    ]


def write_json(path, compression):
    with open(path, "wb") as out:
        writer = Writer(out, compression=compression, chunk_size=1000)
        writer.start("", "samples")
        channels = {}
        for secs, nanos in STAMPS:
            for topic, schema, message in foxglove_dicts(secs, nanos):
                if topic not in channels:
                    schema_id = writer.register_schema(schema, "jsonschema", b"{}")
                    channels[topic] = writer.register_channel(topic, "json", schema_id)
                plain = {
                    key: base64.b64encode(value).decode() if isinstance(value, bytes) else value
                    for key, value in message.items()
                }
                if "ranges" in plain:
                    plain["ranges"] = [r if math.isfinite(r) else None for r in plain["ranges"]]
                time = secs * 10**9 + nanos
                writer.add_message(channels[topic], time, json.dumps(plain).encode(), time)
        writer.finish()


def fill(message, values):
    for key, value in values.items():
        field = getattr(message, key)
        if key == "timestamp":
            message.timestamp.seconds, message.timestamp.nanos = value["sec"], value["nsec"]
        elif isinstance(value, dict):
            fill(field, value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for one in value:
                fill(field.add(), one)
        elif isinstance(value, list):
            field.extend(value)
        else:
            setattr(message, key, value)
    return message


def write_protobuf(path, compression):
    kinds = {
        "foxglove.LaserScan": LaserScan_pb2.LaserScan, "foxglove.PointCloud": PointCloud_pb2.PointCloud,
        "foxglove.RawImage": RawImage_pb2.RawImage,
        "foxglove.CameraCalibration": CameraCalibration_pb2.CameraCalibration,
        "foxglove.FrameTransform": FrameTransform_pb2.FrameTransform,
        "foxglove.FrameTransforms": FrameTransforms_pb2.FrameTransforms,
        "foxglove.PoseInFrame": PoseInFrame_pb2.PoseInFrame,
    }
    with open(path, "wb") as out:
        writer = ProtobufWriter(out, compression=compression, chunk_size=1000)
        for secs, nanos in STAMPS:
            for topic, schema, values in foxglove_dicts(secs, nanos):
                if schema in kinds:
                    time = secs * 10**9 + nanos
                    writer.write_message(topic, fill(kinds[schema](), values), time, time)
        writer.finish()


def ros_messages(store, ros1, secs, nanos):
    """Topics and messages of a type store."""
    of = store.types
    time = of["builtin_interfaces/msg/Time"](sec=secs, nanosec=nanos)
    counter = {"seq": 7} if ros1 else {}
    slash = "/" if ros1 else ""

    def header(frame):
        return of["std_msgs/msg/Header"](stamp=time, frame_id=slash + frame, **counter)

    geometry = lambda name: of[f"geometry_msgs/msg/{name}"]
    point = geometry("Point")(x=1.0, y=-2.0, z=0.5)
    vector = geometry("Vector3")(x=1.0, y=-2.0, z=0.5)
    turn = geometry("Quaternion")(x=0.0, y=0.0, z=HALF, w=HALF)
    pose = geometry("Pose")(position=point, orientation=turn)
    square = numpy.zeros(36)
    sensor = lambda name: of[f"sensor_msgs/msg/{name}"]
    fields = [sensor("PointField")(name=name, offset=4 * at, datatype=7, count=1) for at, name in enumerate("xyz")]
    image = dict(is_bigendian=0)
    roi = sensor("RegionOfInterest")(x_offset=0, y_offset=0, height=0, width=0, do_rectify=False)
    k = dict(D=numpy.array([0.1, 0, 0, 0, 0]), K=numpy.array(K, float), R=numpy.eye(3).flatten(), P=numpy.array(P, float))
    if not ros1:
        k = {key.lower(): value for key, value in k.items()}
    transform = geometry("TransformStamped")(
        header=header("odom"), child_frame_id=slash + "body",
        transform=geometry("Transform")(translation=vector, rotation=turn))
    return [
        ("/scan", sensor("LaserScan")(
            header=header("laser"), angle_min=-1.0, angle_max=1.0, angle_increment=0.5, time_increment=0.0,
            scan_time=0.0, range_min=0.125, range_max=8.0, ranges=numpy.array(RANGES, dtype="f4"),
            intensities=numpy.array([1, 2, 3, 4, 5], dtype="f4"))),
        ("/points", sensor("PointCloud2")(
            header=header("laser"), height=1, width=2, fields=fields, is_bigendian=False, point_step=12,
            row_step=24, data=numpy.frombuffer(POINTS.tobytes(), "u1"), is_dense=True)),
        ("/depth", sensor("Image")(
            header=header("camera"), height=2, width=3, encoding="16UC1", step=6,
            data=numpy.frombuffer(LEVELS.tobytes(), "u1"), **image)),
        ("/depth_m", sensor("Image")(
            header=header("camera"), height=1, width=3, encoding="32FC1", step=12,
            data=numpy.frombuffer(METRES.tobytes(), "u1"), **image)),
        ("/colour", sensor("Image")(
            header=header("camera"), height=1, width=1, encoding="rgb8", step=3,
            data=numpy.array([1, 2, 3], "u1"), **image)),
        ("/camera", sensor("CameraInfo")(
            header=header("camera"), height=2, width=3, distortion_model="plumb_bob", binning_x=0, binning_y=0,
            roi=roi, **k)),
        ("/odom", of["nav_msgs/msg/Odometry"](
            header=header("odom"), child_frame_id=slash + "body",
            pose=geometry("PoseWithCovariance")(pose=pose, covariance=square),
            twist=geometry("TwistWithCovariance")(
                twist=geometry("Twist")(linear=vector, angular=vector), covariance=square))),
        ("/pose", geometry("PoseStamped")(header=header("map"), pose=pose)),
        ("/tf", of["tf2_msgs/msg/TFMessage"](transforms=[transform])),
        ("/other", of["std_msgs/msg/String"](data="hello")),
    ]


def store_of(ros1):
    if not ros1:
        return get_typestore(Stores.ROS2_HUMBLE)
    store = get_typestore(Stores.ROS1_NOETIC)
    transforms = "geometry_msgs/TransformStamped[] transforms\n"
    store.register(get_types_from_msg(transforms, "tf2_msgs/msg/TFMessage"))
    return store


def write_ros_mcap(path, ros1, **options):
    store = store_of(ros1)
    with open(path, "wb") as out:
        writer = Writer(out, chunk_size=1000, **options)
        writer.start("ros1" if ros1 else "ros2", "samples")
        channels = {}
        for secs, nanos in STAMPS:
            for topic, message in ros_messages(store, ros1, secs, nanos):
                name = message.__msgtype__
                if topic not in channels:
                    definition = store.generate_msgdef(name, ros_version=1 if ros1 else 2)[0].encode()
                    shown = name.replace("/msg/", "/") if ros1 else name
                    schema = writer.register_schema(shown, "ros1msg" if ros1 else "ros2msg", definition)
                    channels[topic] = writer.register_channel(topic, "ros1" if ros1 else "cdr", schema)
                data = store.serialize_ros1(message, name) if ros1 else store.serialize_cdr(message, name)
                time = secs * 10**9 + nanos
                writer.add_message(channels[topic], time, bytes(data), time)
        writer.finish()


def write_bag(path, compression):
    path.unlink(missing_ok=True)
    store = store_of(True)
    writer = BagWriter(path)
    if compression:
        writer.set_compression(compression)
    with writer:
        connections = {}
        for secs, nanos in STAMPS:
            for topic, message in ros_messages(store, True, secs, nanos):
                name = message.__msgtype__
                if topic not in connections:
                    connections[topic] = writer.add_connection(topic, name, typestore=store)
                writer.write(connections[topic], secs * 10**9 + nanos, store.serialize_ros1(message, name))


if __name__ == "__main__":
    here = Path(__file__).parent
    write_json(here / "foxglove_json_lz4.mcap", CompressionType.LZ4)
    write_protobuf(here / "foxglove_protobuf_zstd.mcap", CompressionType.ZSTD)
    write_ros_mcap(here / "ros2_zstd.mcap", False, compression=CompressionType.ZSTD)
    write_ros_mcap(
        here / "ros2_bare.mcap", False, use_chunking=False, index_types=IndexType.NONE, use_statistics=False,
        use_summary_offsets=False, repeat_channels=False, repeat_schemas=False)
    write_ros_mcap(here / "ros1_lz4.mcap", True, compression=CompressionType.LZ4)
    write_bag(here / "ros1.bag", None)
    write_bag(here / "ros1_lz4.bag", BagWriter.CompressionFormat.LZ4)
    write_bag(here / "ros1_bz2.bag", BagWriter.CompressionFormat.BZ2)
