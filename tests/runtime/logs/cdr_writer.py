# SPDX-License-Identifier: MIT
"""Messages of ROS packed by hand: CDR of ROS 2 (alignment after four bytes that say how) and the packed form of ROS 1."""
import struct


class Cdr:
    def __init__(self, big=False, version2=False):
        self.order = ">" if big else "<"
        self.most = 4 if version2 else 8
        kind = (6 if version2 else 0) + (0 if big else 1)
        self.head = struct.pack(">HH", kind, 0)
        self.data = b""

    def align(self, size):
        size = min(size, self.most)
        self.data += b"\0" * (-len(self.data) % size)

    def put(self, code, *values):
        for value in values:
            self.align(struct.calcsize(code))
            self.data += struct.pack(self.order + code, value)
        return self

    def text(self, text):
        raw = text.encode() + b"\0"
        self.put("I", len(raw))
        self.data += raw
        return self

    def texts(self, texts):
        self.put("I", len(texts))
        for text in texts:
            self.text(text)
        return self

    def numbers(self, code, values):
        return self.put("I", len(values)).put(code, *values)

    def header(self, ns, frame=""):
        return self.put("i", ns // 10**9).put("I", ns % 10**9).text(frame)

    def bytes(self):
        return self.head + self.data


class Ros1:
    def __init__(self):
        self.data = b""

    def put(self, code, *values):
        for value in values:
            self.data += struct.pack("<" + code, value)
        return self

    def text(self, text):
        raw = text.encode()
        self.put("I", len(raw))
        self.data += raw
        return self

    def texts(self, texts):
        self.put("I", len(texts))
        for text in texts:
            self.text(text)
        return self

    def numbers(self, code, values):
        return self.put("I", len(values)).put(code, *values)

    def header(self, seq, ns, frame=""):
        return self.put("I", seq, ns // 10**9, ns % 10**9).text(frame)

    def bytes(self):
        return self.data


def joint_state(message, names, position, velocity, effort):
    """The fields after the header, of either."""
    return (message.texts(names).numbers("d", position).numbers("d", velocity).numbers("d", effort).bytes())
