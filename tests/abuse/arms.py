# SPDX-License-Identifier: MIT
"""Arms with known numbers, and clean recordings of them."""
import ctypes
import subprocess

import numpy as np

ROWS = ["m", "mX", "mY", "mZ", "XX", "XY", "XZ", "YY", "YZ", "ZZ", "IA", "Fs", "Fv", "off"]

GEOMETRY = {
    "planar2r": dict(sigma=[0, 0], al=["pi/2", "0"], d=[0, 0.5], th=[0, 0], r=[0, 0]),
    "elbow6r": dict(sigma=[0] * 6, al=["0", "-pi/2", "0", "-pi/2", "pi/2", "-pi/2"],
                    d=[0, 0, 0.43, 0.02, 0, 0], th=[0] * 6, r=[0, 0, 0.15, 0.43, 0, 0]),
    "gantry": dict(sigma=[1, 1, 1, 0], al=["0", "pi/2", "pi/2", "0"], d=[0, 0, 0, 0],
                   th=["0", "pi/2", "pi/2", "0"], r=[0, 0, 0, 0]),
}


class Arm:
    """A robot file with numbers, one without, and its torque from dyngen's C code."""

    def __init__(self, name, folder, dyngen):
        self.name, self.folder = name, folder
        self.geometry = GEOMETRY[name]
        self.joints = len(self.geometry["sigma"])
        self.prismatic = np.array(self.geometry["sigma"]) == 1
        self.values = self._values()
        self.true_file = folder / f"{name}_true.robot"
        self.open_file = folder / f"{name}.robot"
        self.true_file.write_text(self.text(numbers=True))
        self.open_file.write_text(self.text(numbers=False))
        code, library = folder / f"{name}.c", folder / f"{name}.so"
        subprocess.run([dyngen, self.true_file, "--functions", "id", "--prefix", "arm", "-o", code],
                       check=True, capture_output=True)
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", code, "-o", library, "-lm"], check=True)
        self.id = ctypes.CDLL(str(library)).arm_id

    def _values(self):
        """Bodies that exist: masses that fall outward, a centre of mass, an inertia about it."""
        random = np.random.default_rng(7)
        values = {row: np.zeros(self.joints) for row in ROWS}
        for j in range(self.joints):
            m = 8.0 / (1 + j)
            c = random.uniform(-0.12, 0.12, 3)
            i = m * np.diag(random.uniform(0.01, 0.02, 3))
            about = i + m * (c @ c * np.eye(3) - np.outer(c, c))
            values["m"][j] = m
            values["mX"][j], values["mY"][j], values["mZ"][j] = m * c
            for key, (a, b) in dict(XX=(0, 0), XY=(0, 1), XZ=(0, 2), YY=(1, 1), YZ=(1, 2),
                                    ZZ=(2, 2)).items():
                values[key][j] = about[a, b]
            values["IA"][j] = 0.3 / (1 + j)
            values["Fs"][j] = 3.0 / (1 + j)
            values["Fv"][j] = 2.0 / (1 + j)
        return values

    def text(self, numbers, gravity=9.81):
        def row(key, cells):
            return f"{key} " + " ".join(str(cell) for cell in cells)

        lines = [f"name {self.name}", f"number_link {self.joints}", "dh modified"]
        lines += [row(key, cells) for key, cells in self.geometry.items()]
        for key in ROWS:
            lines.append(row(key, (repr(float(v)) for v in self.values[key]) if numbers
                             else ["0" if key == "off" else "*"] * self.joints))
        lines += ["gx 0", "gy 0", f"gz {gravity}", "stop"]
        return "\n".join(lines) + "\n"

    def torque(self, q, dq, ddq):
        tau = np.empty_like(q)
        pointer = ctypes.POINTER(ctypes.c_double)
        buffers = [np.empty(self.joints) for _ in range(4)]
        raw = [b.ctypes.data_as(pointer) for b in buffers]
        for k in range(len(q)):
            buffers[0][:], buffers[1][:], buffers[2][:] = q[k], dq[k], ddq[k]
            self.id(*raw)
            tau[k] = buffers[3]
        return tau

    def recording(self, random, rate=500, seconds=10):
        """Sums of sines, with encoder noise and torque noise. Columns: time, q, qd, tau."""
        t = np.arange(int(rate * seconds)) / rate
        q = np.zeros((len(t), self.joints))
        dq, ddq = q.copy(), q.copy()
        for j in range(self.joints):
            reach = 0.25 if self.prismatic[j] else 1.0
            q[:, j] += random.uniform(-0.5, 0.5) * reach
            for harmonic in range(1, 6):
                w = 2 * np.pi * 0.2 * harmonic * random.uniform(0.9, 1.1)
                a, phase = reach * random.uniform(0.2, 0.5) / harmonic, random.uniform(0, 2 * np.pi)
                q[:, j] += a * np.sin(w * t + phase)
                dq[:, j] += a * w * np.cos(w * t + phase)
                ddq[:, j] -= a * w * w * np.sin(w * t + phase)
        tau = self.torque(q, dq, ddq)
        tau += 0.005 * np.abs(tau).max(axis=0) * random.standard_normal(tau.shape)
        return {"t": t, "q": q + 1e-5 * random.standard_normal(q.shape), "qd": dq, "tau": tau}
