"""Small log-log charts as SVG: plain Python, so that any interpreter can run it."""

import math

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, GAP = 400, 300, 56, 46, 34, 30
COLOURS = ["#0b6e99", "#c2410c", "#0b6e99", "#c2410c"]
DASHES = ["", "", "5 4", "5 4"]


def decades(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def label(exponent):
    return f"{10 ** exponent:g}" if -3 <= exponent <= 4 else f"1e{exponent}"


def panel(title, across, up, series, offset):
    """One chart; `series` is a list of (name, [(x, y), ...])."""
    points = [point for _, line in series for point in line]
    (x0, x1), (y0, y1) = decades([x for x, _ in points]), decades([y for _, y in points])
    inner_w, inner_h = WIDTH - LEFT - 14, HEIGHT - BOTTOM - TOP
    place_x = lambda x: offset + LEFT + (math.log10(x) - x0) / max(x1 - x0, 1) * inner_w
    place_y = lambda y: TOP + inner_h - (math.log10(y) - y0) / max(y1 - y0, 1) * inner_h
    out = [f'<text x="{offset + LEFT}" y="18" font-weight="bold">{title}</text>']
    for exponent in range(x0, x1 + 1):
        x = place_x(10.0**exponent)
        out.append(f'<path d="M{x:.1f} {TOP}V{TOP + inner_h}" stroke="#ddd"/>')
        out.append(f'<text x="{x:.1f}" y="{TOP + inner_h + 15}" text-anchor="middle">{label(exponent)}</text>')
    for exponent in range(y0, y1 + 1):
        y = place_y(10.0**exponent)
        out.append(f'<path d="M{offset + LEFT} {y:.1f}H{offset + LEFT + inner_w}" stroke="#ddd"/>')
        out.append(f'<text x="{offset + LEFT - 5}" y="{y + 4:.1f}" text-anchor="end">{label(exponent)}</text>')
    middle = offset + LEFT + inner_w / 2
    out.append(f'<text x="{middle:.0f}" y="{HEIGHT - 12}" text-anchor="middle">{across}</text>')
    out.append(f'<text x="{offset + 12}" y="{TOP - 8}">{up}</text>')
    for at, (name, line) in ((at, each) for at, each in enumerate(series) if each[1]):
        colour, dash = COLOURS[at % 4], DASHES[at % 4]
        way = "L".join(f"{place_x(x):.1f} {place_y(y):.1f}" for x, y in line)
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        out.append(f'<path d="M{way}" fill="none" stroke="{colour}" stroke-width="2"{dashed}/>')
        for x, y in line:
            out.append(f'<circle cx="{place_x(x):.1f}" cy="{place_y(y):.1f}" r="3" fill="{colour}"/>')
        y = TOP + 14 + 15 * at
        out.append(f'<path d="M{offset + LEFT + 10} {y - 4}h22" stroke="{colour}" stroke-width="2"{dashed}/>')
        out.append(f'<text x="{offset + LEFT + 37}" y="{y}">{name}</text>')
    return out


def write(path, panels):
    """`panels` is a list of (title, label across, label upwards, series)."""
    width = len(panels) * (WIDTH + GAP) - GAP
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {HEIGHT}" width="{width}" '
           'font-family="sans-serif" font-size="11" fill="#222">',
           f'<rect width="{width}" height="{HEIGHT}" fill="#fff"/>']
    for at, (title, across, up, series) in enumerate(panels):
        out += panel(title, across, up, series, at * (WIDTH + GAP))
    with open(path, "w") as target:
        target.write("\n".join(out + ["</svg>", ""]))
