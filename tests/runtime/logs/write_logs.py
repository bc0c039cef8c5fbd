# SPDX-License-Identifier: MIT
"""write_logs.py FOLDER: logs of all formats, by writers that are not this project's. Beside each stands NAME.expected: a
line "table", "columns", "units" and the rows of each table, tab-separated, numbers with 17 digits: what the reader must
give, exactly. Formats whose python package is absent are left out, and named in FOLDER/absent."""
import json
import os
import sqlite3
import struct
import sys
import zlib

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from cdr_writer import Cdr, Ros1, joint_state  # noqa: E402

folder = sys.argv[1]
absent = []
NAN = float("nan")


def path(name):
    return os.path.join(folder, name)


def expect(name, *tables):
    """tables: (name, columns, units, rows)"""
    with open(path(name + ".expected"), "w") as out:
        for table, columns, units, rows in tables:
            out.write("table\t%s\n" % table)
            out.write("\t".join(["columns"] + list(columns)) + "\n")
            out.write("\t".join(["units"] + list(units)) + "\n")
            for row in rows:
                out.write("\t".join(["row"] + ["%.17g" % value for value in row]) + "\n")


def motion(rows=50, joints=3):
    rng = np.random.default_rng(7)
    t = np.arange(rows) * 0.004
    return t, rng.standard_normal((rows, joints)), rng.standard_normal((rows, joints))


def columns_of(name, count):
    return ["%s[%d]" % (name, k + 1) for k in range(count)]


# ---- ROS 2

JOINT_STATE = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
# comments are left out
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
CUSTOM = """# a message of somebody
uint8 OFF=0
std_msgs/Header header
bool on
int16[3] counts
float32 gain 0.5
string<=20 mode
Pair[<=4] pairs
uint64 ticks
builtin_interfaces/Duration age
uint8[] picture
================================================================================
MSG: some_msgs/Pair
float64 a
int8 b
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
"""
START = 1423155837204875566


def joint_states(count=40):
    """(received, bytes, row): names change their order, and one is missing at times."""
    rng = np.random.default_rng(3)
    out = []
    for i in range(count):
        order = [["a", "b", "c"], ["c", "a", "b"], ["b", "a"]][i % 3]
        position = {k: rng.standard_normal() for k in order}
        velocity = {k: rng.standard_normal() for k in order}
        effort = {k: rng.standard_normal() for k in order} if i % 2 else {}
        stamp, received = START + i * 8_000_001, START + 5_000_000 + i * 8_000_123
        big, two = i % 5 == 0, i % 7 == 0
        message = Cdr(big, two).header(stamp, "base")
        data = joint_state(message, order, [position[k] for k in order], [velocity[k] for k in order],
                           [effort[k] for k in order if effort])
        row = [i * 8_000_123 / 1e9, i * 8_000_001 / 1e9]
        for part in (position, velocity, effort):
            row += [part.get(k, NAN) for k in "abc"]
        out.append((received, data, row))
    return out


JOINT_COLUMNS = ["received", "stamp"] + ["%s[%s]" % (p, k) for p in ("position", "velocity", "effort") for k in "abc"]
# effort comes in the second message first, whose order of names is c, a, b
JOINT_COLUMNS_SEEN = JOINT_COLUMNS[:8] + ["effort[c]", "effort[a]", "effort[b]"]
SEEN = [JOINT_COLUMNS.index(name) for name in JOINT_COLUMNS_SEEN]
JOINT_UNITS = ["s", "s"] + [""] * 9


def in_seen_order(row):
    return [row[k] for k in SEEN]


def wrench(i):
    force = [0.1 * i, -i, 1e-3 * i * i]
    data = Cdr().header(START + i, "tool").put("d", *force, 1.0, 2.0, 3.5).bytes()
    return data, force + [1.0, 2.0, 3.5]


def write_database(name, definitions):
    if os.path.exists(path(name)):
        os.remove(path(name))
    base = sqlite3.connect(path(name))
    base.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
                 " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
    base.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
                 " timestamp INTEGER NOT NULL, data BLOB NOT NULL)")
    base.execute("INSERT INTO topics VALUES(3, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr', '')")
    base.execute("INSERT INTO topics VALUES(5, '/wrench', 'geometry_msgs/msg/WrenchStamped', 'cdr', '')")
    base.execute("INSERT INTO topics VALUES(6, '/strange', 'who_msgs/msg/Knows', 'cdr', '')")
    if definitions:
        base.execute("CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT, encoding TEXT,"
                     " encoded_message_definition TEXT, type_description_hash TEXT)")
        base.execute("INSERT INTO message_definitions VALUES(1, 'sensor_msgs/msg/JointState', 'ros2msg', ?, '')",
                     (JOINT_STATE,))
    rows, wrenches = [], []
    first = START + 5_000_000
    for i, (received, data, row) in enumerate(joint_states()):
        base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(3, ?, ?)", (received, data))
        rows.append(in_seen_order(row))
        if i % 4 == 0:
            data, values = wrench(i)
            base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(5, ?, ?)", (received + 77, data))
            base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(6, ?, ?)", (received, b"??"))
            wrenches.append([(received + 77 - first) / 1e9, i / 1e9] + values)
    base.commit()
    base.close()
    wrench_columns = ["received", "stamp"] + ["wrench.%s.%s" % (p, k) for p in ("force", "torque") for k in "xyz"]
    expect(name, ("/joint_states", JOINT_COLUMNS_SEEN, JOINT_UNITS, rows),
           ("/wrench", wrench_columns, ["s", "s"] + [""] * 6, wrenches))


write_database("humble.db3", False)
write_database("iron.db3", True)


def controller_states():
    name = "controllers.db3"
    if os.path.exists(path(name)):
        os.remove(path(name))
    base = sqlite3.connect(path(name))
    base.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)")
    base.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)")
    types = ["control_msgs/msg/JointTrajectoryControllerState", "control_msgs/msg/DynamicJointState",
             "std_msgs/msg/Float64MultiArray", "sensor_msgs/msg/Imu", "std_msgs/msg/Float64",
             "sensor_msgs/msg/Temperature"]
    for i, kind in enumerate(types):
        base.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr')", (i, "/t%d" % i, kind))
    rows = [[] for _ in types]
    for i in range(12):
        at = i * 10**7
        state = Cdr().header(START + at).texts(["j1", "j2"])
        row = [at / 1e9, at / 1e9]
        for part in range(3):
            positions, velocities = [i + part, -i - 0.5 * part], [0.25 * i, part]
            state.numbers("d", positions).numbers("d", velocities).numbers("d", []).numbers("d", [])
            state.put("i", 1).put("I", 500_000_000)
            row += positions + velocities + [1.5]
        rows[0].append(row)
        dynamic = Cdr().header(START + at).texts(["j1", "j2"]).put("I", 2)
        dynamic.texts(["position", "effort"]).numbers("d", [i, 2 * i])
        dynamic.texts(["position"]).numbers("d", [3 * i])
        rows[1].append([at / 1e9, at / 1e9, i, 2 * i, 3 * i])
        array = Cdr().put("I", 1).text("joints").put("I", 3, 3, 0).numbers("d", [i, i + 0.5, i + 0.25])
        rows[2].append([at / 1e9, 3, 3, 0, i, i + 0.5, i + 0.25])
        values = [0.5 * k + i for k in range(37)]
        rows[3].append([at / 1e9, at / 1e9] + values)
        imu = Cdr().header(START + at, "imu").put("d", *values)
        number = Cdr().put("d", 0.1 * i)
        rows[4].append([at / 1e9, 0.1 * i])
        temperature = Cdr().header(START + at).put("d", 20 + i, 0.5)
        rows[5].append([at / 1e9, at / 1e9, 20 + i, 0.5])
        for topic, message in enumerate([state, dynamic, array, imu, number, temperature]):
            base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                         (topic, START + at, message.bytes()))
    base.commit()
    base.close()
    points = [c for p in ("desired", "actual", "error") for c in
              [p + ".positions[j1]", p + ".positions[j2]", p + ".velocities[j1]", p + ".velocities[j2]",
               p + ".time_from_start"]]
    both = ["received", "stamp"]
    covariance = ["orientation", "angular_velocity", "linear_acceleration"]
    imu_columns = both[:]
    for part in covariance:
        imu_columns += ["%s.%s" % (part, k) for k in ("xyzw" if part == "orientation" else "xyz")]
        imu_columns += columns_of(part + "_covariance", 9)
    columns = [both + points,
               both + ["interface_values[j1].values[position]", "interface_values[j1].values[effort]",
                       "interface_values[j2].values[position]"],
               ["received", "layout.dim[1].size", "layout.dim[1].stride", "layout.data_offset"] + columns_of("data", 3),
               imu_columns, ["received", "data"], both + ["temperature", "variance"]]
    expect(name, *[("/t%d" % i, columns[i],
                    ["s" if c in both else "" for c in columns[i]], rows[i]) for i in range(len(types))])


controller_states()


# ---- MCAP (mcap.dev/spec)

def mcap_text(text):
    raw = text if isinstance(text, bytes) else text.encode()
    return struct.pack("<I", len(raw)) + raw


def mcap_record(kind, content):
    return struct.pack("<BQ", kind, len(content)) + content


def mcap_file(pack, method):
    """Chunks packed by `pack`; None: no chunks at all."""
    magic = b"\x89MCAP0\r\n"
    schema = mcap_record(3, struct.pack("<H", 1) + mcap_text("sensor_msgs/msg/JointState") + mcap_text("ros2msg")
                         + mcap_text(JOINT_STATE))
    channel = mcap_record(4, struct.pack("<HH", 9, 1) + mcap_text("/joint_states") + mcap_text("cdr")
                          + struct.pack("<I", 0))
    custom = mcap_record(3, struct.pack("<H", 2) + mcap_text("some_msgs/msg/Custom") + mcap_text("ros2msg")
                         + mcap_text(CUSTOM))
    custom_channel = mcap_record(4, struct.pack("<HH", 11, 2) + mcap_text("/custom") + mcap_text("cdr")
                                 + struct.pack("<I", 0))
    json_channel = mcap_record(4, struct.pack("<HH", 12, 0) + mcap_text("/json") + mcap_text("json")
                               + struct.pack("<I", 0))
    proto_channel = mcap_record(4, struct.pack("<HH", 13, 0) + mcap_text("/proto") + mcap_text("protobuf")
                                + struct.pack("<I", 0))
    rows, customs, jsons, messages = [], [], [], []
    first = START + 5_000_000

    def message(channel_id, number, received, data):
        messages.append(mcap_record(5, struct.pack("<HIQQ", channel_id, number, received, received) + data))

    for i, (received, data, row) in enumerate(joint_states()):
        message(9, i, received, data)
        rows.append(in_seen_order(row))
        one = Cdr().header(START + i).put("B", i % 2).put("h", i, -i, 7).put("f", 0.5 * i).text("run")
        one.put("I", 2).put("d", i).put("b", -3).put("d", 2 * i).put("b", 4)
        one.put("Q", 2**60 + i).put("i", -1).put("I", 250_000_000).put("I", 3).put("B", 1, 2, 3)
        message(11, i, received + 5, one.bytes())
        customs.append([(received + 5 - first) / 1e9, i / 1e9, i % 2, i, -i, 7, 0.5 * i, i, -3, 2 * i, 4, i, -0.75])
        message(12, i, received + 6, json.dumps({"a": {"b": [i, 0.5]}, "on": True}).encode())
        jsons.append([(received + 6 - first) / 1e9, i, 0.5, 1])
        message(13, i, received + 7, b"\x08\x01")
    out = magic + mcap_record(1, mcap_text("ros2") + mcap_text("by hand"))
    head = schema + channel + custom + custom_channel + json_channel + proto_channel
    if pack is None:
        out += head + b"".join(messages)
    else:
        for begin in range(0, len(messages), 30):
            records = (head if begin == 0 else b"") + b"".join(messages[begin:begin + 30])
            packed = pack(records)
            out += mcap_record(6, struct.pack("<QQQI", 0, 1, len(records), zlib.crc32(records)) + mcap_text(method)
                               + struct.pack("<Q", len(packed)) + packed)
            out += mcap_record(7, struct.pack("<HI", 9, 0))
    out += mcap_record(0x80, b"of somebody")
    out += mcap_record(15, struct.pack("<I", 0)) + head + mcap_record(2, struct.pack("<QQI", 0, 0, 0)) + magic
    tables = [("/joint_states", JOINT_COLUMNS_SEEN, JOINT_UNITS, rows),
              ("/custom", ["received", "stamp", "on"] + columns_of("counts", 3)
               + ["gain", "pairs[1].a", "pairs[1].b", "pairs[2].a", "pairs[2].b", "ticks", "age"],
               ["s", "s"] + [""] * 11, customs),
              ("/json", ["received", "a.b[1]", "a.b[2]", "on"], ["s", "", "", ""], jsons)]
    return out, tables


def write_mcap(name, pack, method):
    data, tables = mcap_file(pack, method)
    with open(path(name), "wb") as out:
        out.write(data)
    expect(name, *tables)


write_mcap("records.mcap", None, "")
write_mcap("chunks.mcap", lambda data: data, "")
try:
    import lz4.frame
    write_mcap("lz4.mcap", lz4.frame.compress, "lz4")
except ImportError:
    absent.append("python3-lz4")
try:
    import zstandard
    write_mcap("zstd.mcap", zstandard.ZstdCompressor().compress, "zstd")
except ImportError:
    absent.append("python3-zstandard")

# ---- ROS 1 bag, version 2.0

JOINT_STATE_1 = JOINT_STATE.replace("builtin_interfaces/Time stamp", "uint32 seq\ntime stamp")


def bag_header(fields):
    out = b""
    for name, value in fields:
        field = name.encode() + b"=" + value
        out += struct.pack("<I", len(field)) + field
    return struct.pack("<I", len(out)) + out


def bag_record(fields, data):
    return bag_header(fields) + struct.pack("<I", len(data)) + data


def write_bag(name, method, pack):
    connection = bag_header([("topic", b"/joint_states"), ("type", b"sensor_msgs/JointState"),
                             ("md5sum", b"3066dcd76a6cfaef579bd0f34173e9fd"),
                             ("message_definition", JOINT_STATE_1.encode())])[4:]
    records, rows = [], []
    for i in range(30):
        ns = START + i * 4_000_003
        values = [[0.5 * i, -i], [i, 2 * i], [1e-3 * i, 0.125]]
        data = joint_state(Ros1().header(i, ns + 11, "world"), ["left", "right"], *values)
        time = struct.pack("<II", ns // 10**9, ns % 10**9)
        records.append(bag_record([("op", b"\x02"), ("conn", struct.pack("<I", 0)), ("time", time)], data))
        rows.append([i * 4_000_003 / 1e9, i, i * 4_000_003 / 1e9] + sum(values, []))
    described = bag_record([("op", b"\x07"), ("conn", struct.pack("<I", 0)), ("topic", b"/joint_states")], connection)
    out = b"#ROSBAG V2.0\n"
    out += bag_record([("op", b"\x03"), ("index_pos", struct.pack("<Q", 0)), ("conn_count", struct.pack("<I", 1)),
                       ("chunk_count", struct.pack("<I", 3))], b" " * 4027)
    for begin in range(0, 30, 10):
        chunk = (described if begin == 0 else b"") + b"".join(records[begin:begin + 10])
        out += bag_record([("op", b"\x05"), ("compression", method.encode()),
                           ("size", struct.pack("<I", len(chunk)))], pack(chunk))
        out += bag_record([("op", b"\x04"), ("ver", struct.pack("<I", 1)), ("conn", struct.pack("<I", 0)),
                           ("count", struct.pack("<I", 0))], b"")
    out += described
    with open(path(name), "wb") as file:
        file.write(out)
    columns = ["received", "seq", "stamp"] + ["%s[%s]" % (p, k) for p in ("position", "velocity", "effort")
                                              for k in ("left", "right")]
    expect(name, ("/joint_states", columns, ["s", "", "s"] + [""] * 6, rows))


import bz2  # noqa: E402
write_bag("plain.bag", "none", lambda data: data)
write_bag("bz2.bag", "bz2", bz2.compress)
if "python3-lz4" not in absent:
    write_bag("lz4.bag", "lz4", lz4.frame.compress)

# ---- NumPy

t, q, tau = motion()


def save(name, array, *tables):
    np.save(path(name), array)
    expect(name, *tables)


save("two_sides.npy", q, ("", ["1", "2", "3"], [""] * 3, q))
save("fortran.npy", np.asfortranarray(q), ("", ["1", "2", "3"], [""] * 3, q))
save("turned.npy", q.T.copy(), ("", ["1", "2", "3"], [""] * 3, q))
save("turned_fortran.npy", np.asfortranarray(q.T), ("", ["1", "2", "3"], [""] * 3, q))
save("big_endian.npy", q.astype(">f8"), ("", ["1", "2", "3"], [""] * 3, q))
save("single.npy", q.astype("f4"), ("", ["1", "2", "3"], [""] * 3, q.astype("f4").astype(float)))
save("half.npy", t.astype("f2"), ("", ["1"], [""], t.astype("f2").astype(float)[:, None]))
for kind in ("i1", "u1", ">i2", "u2", "i4", ">u4", "i8", "u8"):
    whole = (np.arange(50) % 100).astype(kind)
    save("whole_%s.npy" % kind.replace(">", "b"), whole, ("", ["1"], [""], whole.astype(float)[:, None]))
save("truth.npy", np.arange(50) % 2 == 0, ("", ["1"], [""], (np.arange(50) % 2 == 0).astype(float)[:, None]))
save("stamps.npy", START + np.arange(50) * 3, ("", ["1"], [""], (np.arange(50) * 3.0)[:, None]))
save("dates.npy", (START + np.arange(50) * 10**6).astype("M8[ns]"), ("", ["1"], ["s"], (np.arange(50) / 1e3)[:, None]))
record = np.zeros(50, dtype=[("t", ">f8"), ("q", "<f4", (3,)), ("sub", [("on", "?"), ("count", "<i2")]), ("word", "S3")])
record["t"], record["q"], record["sub"]["on"], record["sub"]["count"] = t, q, True, np.arange(50) - 9
save("record.npy", record, ("", ["t"] + columns_of("q", 3) + ["sub.on", "sub.count"], [""] * 6,
                            np.column_stack([t, q.astype("f4"), np.ones(50), np.arange(50) - 9])))
for name, save_all in (("stored.npz", np.savez), ("packed.npz", np.savez_compressed)):
    save_all(path(name), t=t, q=q, tau=tau.T, gain=np.float64(0.5), slow=np.arange(20.0), word=np.array("x"))
    expect(name, ("", ["t"] + columns_of("q", 3) + columns_of("tau", 3), [""] * 7, np.column_stack([t, q, tau])),
           ("(20 rows)", ["slow"], [""], np.arange(20.0)[:, None]))
np.save(path("object.npy"), np.array([{"a": 1}, None], dtype=object), allow_pickle=True)

# ---- JSON

with open(path("lines.jsonl"), "w") as out:
    for i in range(30):
        line = {"t": 0.1 * i, "state": {"q": [i, 0.5 * i], "on": i % 2 == 0}, "stamp": START + i, "name": "x"}
        if i % 3 == 0:
            line["extra"] = None if i % 2 else -i
        if i == 4:
            line["t"] = NAN
        out.write(json.dumps(line) + "\n")
expect("lines.jsonl", ("", ["t", "state.q[1]", "state.q[2]", "state.on", "stamp", "extra"], [""] * 6,
                       [[NAN if i == 4 else 0.1 * i, i, 0.5 * i, float(i % 2 == 0), i,
                         -i if i % 6 == 0 else NAN] for i in range(30)]))
entries = [{"t": 0.01 * i, "q": [i, -i], "when": "2026-11-28T10:00:%02d.5Z" % i, "mode": "run"} for i in range(40)]
with open(path("document.json"), "w") as out:
    json.dump({"mass": 0.49, "setup": {"kp": 100, "gravity": [0, 0, -9.81]}, "entries": entries}, out, indent=1)
expect("document.json", ("entries", ["t", "q[1]", "q[2]", "when"], ["", "", "", "s"],
                         [[0.01 * i, i, -i, i] for i in range(40)]))
with open(path("columns.json"), "w") as out:
    json.dump({"run": {"t": list(t), "q": q.tolist()}, "version": 2}, out)
expect("columns.json", ("run", columns_of("q", 3) + ["t"], [""] * 4, np.column_stack([q, t])))
with open(path("channels.json"), "w") as out:
    json.dump({"time": list(t), "pos": q.T.tolist(), "state": {"tau": tau.T.tolist(), "same": tau.tolist()},
               "inertia": np.eye(3).tolist()}, out)
expect("channels.json", ("", columns_of("pos", 3) + ["time"], [""] * 4, np.column_stack([q, t])),
       ("state", columns_of("same", 3) + columns_of("tau", 3), [""] * 6, np.column_stack([tau, tau])))
with open(path("rows.json"), "w") as out:
    json.dump(np.column_stack([t, q]).tolist(), out)
expect("rows.json", ("", ["1", "2", "3", "4"], [""] * 4, np.column_stack([t, q])))

# ---- MATLAB 5

try:
    import scipy.io
    names = np.empty((1, 2), dtype=object)
    names[:] = ["a", "b"]
    variables = {
        "rec": {"time": t[:, None], "pos": q.T, "motor": {"pos": tau, "count": np.arange(50, dtype="i4")[:, None]},
                "label": "x", "cells": names},
        "alone": q.astype("f4"), "flags": (np.arange(50) % 2 == 0), "wide": np.arange(50, dtype="u2")[None, :],
        "stamps": (START + np.arange(50))[:, None], "gain": 0.5, "words": "text",
        "other": np.arange(20.0)[:, None]}
    for name, packed in (("five.mat", False), ("seven.mat", True)):
        scipy.io.savemat(path(name), variables, do_compression=packed, oned_as="column")
        expect(name, ("rec", ["time"] + columns_of("pos", 3) + columns_of("motor.pos", 3) + ["motor.count"], [""] * 8,
                      np.column_stack([t, q, tau, np.arange(50)])),
               ("", columns_of("alone", 3) + ["flags", "wide", "stamps"], [""] * 6,
                np.column_stack([q.astype("f4").astype(float), np.arange(50) % 2 == 0, np.arange(50), np.arange(50)])),
               ("(20 rows)", ["other"], [""], np.arange(20.0)[:, None]))
except ImportError:
    absent.append("python3-scipy")

# ---- HDF5, and MATLAB 7.3, which is HDF5 with names for its classes

try:
    import h5py
    with h5py.File(path("groups.h5"), "w") as file:
        file["robot/time"] = t
        file["robot/time"].attrs["units"] = "s"
        file["robot/joint/q"] = q.T
        file["robot/joint/q"].attrs["unit"] = np.bytes_("rad")
        file.create_dataset("robot/tau", data=tau, compression="gzip", chunks=(7, 2), shuffle=True, fletcher32=True)
        file["robot/on"] = np.arange(50) % 2 == 0
        file["robot/name"] = "x"
        file["robot/cube"] = np.zeros((3, 3, 3))
        file["stamps"] = START + np.arange(50)
        file["big"] = q.astype(">f4")
        table = np.zeros(50, dtype=[("t", "f8"), ("n", "<i4"), ("stamp", "i8"), ("word", "S3")])
        table["t"], table["n"], table["stamp"] = t, np.arange(50), START + np.arange(50)
        file["deep/table"] = table
        arrays = np.zeros(50, dtype=[("t", "f8"), ("q", "f8", (3,)), ("n", "<i8", (2, 2))])
        arrays["t"], arrays["q"] = t, q
        arrays["n"] = np.arange(200).reshape(50, 2, 2)
        file["deep/vectors"] = arrays
    expect("groups.h5", ("", columns_of("big", 3) + ["stamps"], [""] * 4,
                         np.column_stack([q.astype("f4").astype(float), np.arange(50)])),
           ("deep/table", ["t", "n", "stamp"], [""] * 3, np.column_stack([t, np.arange(50), np.arange(50)])),
           ("deep/vectors", ["t"] + columns_of("q", 3) + columns_of("n", 4), [""] * 8,
            np.column_stack([t, q, np.arange(200).reshape(50, 4)])),
           ("robot", columns_of("joint/q", 3) + ["on"] + columns_of("tau", 3) + ["time"],
            ["rad"] * 3 + [""] * 4 + ["s"], np.column_stack([q, np.arange(50) % 2 == 0, tau, t])))

    with h5py.File(path("seven_three.mat"), "w", userblock_size=512) as file:
        def of_class(place, kind):
            text = h5py.h5t.C_S1.copy()
            text.set_size(len(kind))
            text.set_strpad(h5py.h5t.STR_NULLTERM)
            space = h5py.h5s.create(h5py.h5s.SCALAR)
            h5py.h5a.create(place.id, b"MATLAB_class", text, space).write(np.array(kind), mtype=text)

        def matlab(place, name, array, kind=b"double"):
            of_class(place.create_dataset(name, data=np.atleast_2d(array).T), kind)  # MATLAB's order of sides
        rec = file.create_group("rec")
        of_class(rec, b"struct")
        fields = np.empty(2, dtype=object)
        for k, field in enumerate([b"time", b"pos"]):
            fields[k] = np.frombuffer(field, "S1")
        rec.attrs.create("MATLAB_fields", fields, dtype=h5py.vlen_dtype(np.dtype("S1")))
        matlab(rec, "time", t[:, None])
        matlab(rec, "pos", q)
        matlab(file, "count", np.arange(50, dtype="i4")[:, None], b"int32")
    with open(path("seven_three.mat"), "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Sat Nov 28 10:00:00 2026 HDF5 schema 1.00 ."
                   .ljust(124) + b"\x00\x02IM")
    expect("seven_three.mat", ("", ["count"], [""], np.arange(50.0)[:, None]),
           ("rec", ["time"] + columns_of("pos", 3), [""] * 4, np.column_stack([t, q])))
except ImportError:
    absent.append("python3-h5py")

with open(path("absent"), "w") as out:
    out.write("\n".join(absent))
