#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/picture.svg from real files: a robot file, the code dyngen wrote from it, and the speed table.

Run from the top of the project after `regenerate_all` and after docs/reference/benchmarks.md got new numbers:
    python3 docs/picture.py
"""

import html
import re
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
FONT = 'font-family="DejaVu Sans Mono, Menlo, Consolas, monospace"'
SANS = 'font-family="DejaVu Sans, Helvetica, Arial, sans-serif"'
LINE = 15


def robot_excerpt():
    wanted = r"(name|number_link|sigma|al|d|th|r|m|mX|ZZ|IA|Fs|gz|stop)\s"
    lines = []
    for line in (TOP / "robots/puma560.robot").read_text().splitlines():
        if re.match(wanted, line + " "):
            line = re.sub(r"\s*#.*", "", line)
            keyword, _, values = line.partition(" ")
            lines.append(f"{keyword:<12}" + "  ".join(values.split()))
    return [line if len(line) <= 58 else line[:55] + "..." for line in lines]


def code_excerpt():
    text = (TOP / "generated/puma560/puma560.c").read_text()
    body = text[text.index("void puma560_id(") :]
    lines = body[body.index("/* forward, link 3") :].splitlines()
    lines[0] = "  /* forward, link 3: W angular velocity, WP its derivative ... */"
    lines = [line if len(line) <= 72 else line[:69] + "..." for line in lines]
    return ["void puma560_id(const double *q, ..., double *tau) {", "  ..."] + lines[:17] + ["  ..."]


def speed_rows():
    """(robot, dyngen ns, MuJoCo ns, KDL ns) of inverse dynamics, numbers in the code."""
    rows = []
    header = None
    for line in (TOP / "docs/reference/benchmarks.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells[:2] == ["function", "robot"]:
            if header:  # the second table is of other parameters
                break
            header = cells
        elif header and cells[0] == "id" and len(cells) == len(header):
            row = dict(zip(header, cells))
            rows.append((row["robot"], float(row["native"]), float(row["MuJoCo"]), float(row["KDL"])))
    return rows


def panel(x, y, width, height, title):
    return [
        f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="8" fill="#ffffff" stroke="#c9d1d9"/>',
        f'<text x="{x + 14}" y="{y + 24}" {SANS} font-size="13" font-weight="bold" fill="#24292f">{title}</text>',
    ]


def code(x, y, lines):
    out = []
    for i, line in enumerate(lines):
        color = "#6e7781" if line.strip().startswith("/*") or line.strip() == "..." else "#24292f"
        out.append(
            f'<text x="{x}" y="{y + i * LINE}" {FONT} font-size="11" fill="{color}" '
            f'xml:space="preserve">{html.escape(line)}</text>'
        )
    return out


def bars(x, y, width):
    rows = speed_rows()
    largest = max(max(row[1:]) for row in rows)
    colors = {"dyngen": "#0969da", "MuJoCo": "#9aa4af", "KDL": "#c9d1d9"}
    out = []
    for robot, *times in rows:
        out.append(f'<text x="{x}" y="{y + 24}" {SANS} font-size="12" fill="#24292f">{robot}</text>')
        for k, (name, time) in enumerate(zip(colors, times)):
            length = (width - 190) * time / largest
            top = y + 3 + k * 14
            ratio = "" if k == 0 else f"  ({time / times[0]:.1f} x)"
            out.append(f'<rect x="{x + 80}" y="{top}" width="{length:.1f}" height="11" fill="{colors[name]}"/>')
            out.append(
                f'<text x="{x + 86 + length:.1f}" y="{top + 10}" {SANS} font-size="10.5" fill="#57606a">'
                f"{name} {time:.0f} ns{ratio}</text>"
            )
        y += 54
    return out


def main():
    robot, source = robot_excerpt(), code_excerpt()
    top = max(len(robot), len(source)) * LINE + 46
    bottom = 54 * len(speed_rows()) + 46
    width, height = 1020, top + bottom + 44
    svg = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">',
        f'<rect width="{width}" height="{height}" fill="#f6f8fa"/>',
    ]
    svg += panel(14, 14, 440, top, "puma560.robot")
    svg += code(28, 58, robot)
    svg += ['<path d="M462 150 h26 m-9 -8 l9 8 l-9 8" stroke="#0969da" stroke-width="3" fill="none"/>']
    svg += panel(498, 14, 508, top, "puma560.c")
    svg += code(512, 58, source)
    svg += panel(14, top + 28, 992, bottom, "Inverse dynamics, time of one call (one process, 4096 random states)")
    svg += bars(28, top + 64, 964)
    svg += ["</svg>"]
    (TOP / "docs/picture.svg").write_text("\n".join(svg) + "\n")


if __name__ == "__main__":
    main()
