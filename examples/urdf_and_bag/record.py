#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes run.db3: joint states of a simulated arm, as `ros2 bag record /joint_states` keeps them.

The arm has other masses and more friction than arm.urdf says, and a spring that carries the upper arm, of which arm.urdf
says nothing. The motion is one period of 4 s, five times.
"""
import os
import sqlite3
import struct

import numpy as np

RATE = 125.0  # Hz, that of many drivers
PERIOD = 4.0  # s
PERIODS = 5
SEED = 7

# the arm: kg, m, kg m^2 about the centre of mass
M1, C1, I1, L1 = 4.6, 0.21, 0.075, 0.45
M2, C2, I2 = 2.7, 0.19, 0.031
VISCOUS, COULOMB = np.array([1.8, 0.7]), np.array([2.4, 1.1])
SPRING, REST = 14.0, -0.9  # N m/rad, rad: of the shoulder
GRAVITY = 9.81
TORQUE_NOISE, ENCODER = np.array([0.12, 0.05]), 2 * np.pi / 2**18


def motion(t):
    """Sums of sines of the period: q, dq, ddq, each of two joints."""
    amplitude = np.array([[0.62, 0.30, -0.13, 0.06], [0.75, -0.38, 0.20, -0.07]])
    phase = np.array([[0.3, 1.9, -0.8, 2.2], [1.1, 0.2, 2.5, -1.3]])
    order = np.array([1, 2, 3, 5])
    w = 2 * np.pi * order / PERIOD
    angle = w[None, None, :] * t[:, None, None] + phase[None]
    q = np.sum(amplitude * np.sin(angle), axis=2) + np.array([-0.5, 0.4])
    return q, np.sum(amplitude * w * np.cos(angle), axis=2), -np.sum(amplitude * w**2 * np.sin(angle), axis=2)


def torque(q, dq, ddq):
    """Lagrange's equations of two links in a vertical plane; q turns about +y, so that +q lowers the link."""
    h = M2 * L1 * C2
    m22 = I2 + M2 * C2**2
    m12 = m22 + h * np.cos(q[:, 1])
    m11 = I1 + M1 * C1**2 + M2 * L1**2 + m22 + 2 * h * np.cos(q[:, 1])
    s = h * np.sin(q[:, 1])
    g2 = -GRAVITY * M2 * C2 * np.cos(q[:, 0] + q[:, 1])
    g1 = -GRAVITY * (M1 * C1 + M2 * L1) * np.cos(q[:, 0]) + g2
    first = m11 * ddq[:, 0] + m12 * ddq[:, 1] - s * (2 * dq[:, 0] * dq[:, 1] + dq[:, 1] ** 2) + g1
    first += SPRING * (q[:, 0] - REST)
    second = m12 * ddq[:, 0] + m22 * ddq[:, 1] + s * dq[:, 0] ** 2 + g2
    return np.stack([first, second], axis=1) + VISCOUS * dq + COULOMB * np.sign(dq)


def joint_state(stamp, names, position, velocity, effort):
    """sensor_msgs/msg/JointState in CDR, little-endian."""
    data = bytearray(b"\x00\x01\x00\x00")

    def align(size):
        data.extend(b"\x00" * (-(len(data) - 4) % size))

    def string(text):
        align(4)
        data.extend(struct.pack("<I", len(text) + 1) + text.encode() + b"\x00")

    data.extend(struct.pack("<iI", stamp // 10**9, stamp % 10**9))
    string("")
    align(4)
    data.extend(struct.pack("<I", len(names)))
    for name in names:
        string(name)
    for values in (position, velocity, effort):
        align(4)
        data.extend(struct.pack("<I", len(values)))
        align(8)
        data.extend(struct.pack(f"<{len(values)}d", *values))
    return bytes(data)


def main():
    random = np.random.default_rng(SEED)
    t = np.arange(int(RATE * PERIOD * PERIODS)) / RATE
    q, dq, ddq = motion(t)
    tau = torque(q, dq, ddq) + random.normal(size=q.shape) * TORQUE_NOISE
    q = np.round(q / ENCODER) * ENCODER
    dq = dq + 0.01 * random.normal(size=q.shape)
    stamps = 1_700_000_000 * 10**9 + np.round(t * 1e9).astype(np.int64)
    if os.path.exists("run.db3"):
        os.remove("run.db3")
    bag = sqlite3.connect("run.db3")
    bag.execute(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)"
    )
    bag.execute(
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
        "data BLOB NOT NULL)"
    )
    bag.execute("INSERT INTO topics VALUES(1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr', '')")
    # drivers name joints in an order of their own
    for k, stamp in enumerate(stamps):
        data = joint_state(int(stamp), ["elbow", "shoulder"], q[k, ::-1], dq[k, ::-1], tau[k, ::-1])
        bag.execute("INSERT INTO messages VALUES(?, 1, ?, ?)", (k + 1, int(stamp) + 300_000, data))
    bag.commit()
    bag.execute("VACUUM")
    bag.close()


if __name__ == "__main__":
    main()
