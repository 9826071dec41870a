#!/usr/bin/env python3
"""Draws the rooms of server/ and which of them include which, as docs/rooms.svg.

    scripts/draw_rooms.py            writes the picture
    scripts/draw_rooms.py --check    exit 1 when the picture in docs/ is not that of today's includes

A room stands above all rooms that it includes. An arrow that follows from others is left out.
"""
import html
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ROOT / 'docs' / 'rooms.svg'
INCLUDE = re.compile(r'^#include "(\w+)/', re.M)
BOX_WIDTH, BOX_HEIGHT, GAP_X, GAP_Y, MARGIN = 118, 44, 20, 58, 20


def rooms_and_includes():
    """Each room with the rooms whose headers it includes."""
    server = ROOT / 'server'
    rooms = sorted(folder.name for folder in server.iterdir() if folder.is_dir())
    included = {}
    for room in rooms:
        found = set()
        for file in sorted((server / room).rglob('*.?pp')):
            found.update(INCLUDE.findall(file.read_text(encoding='utf-8')))
        included[room] = {other for other in found if other in rooms and other != room}
    return included


def reached_from(room, included):
    reached, left = set(), list(included[room])
    while left:
        other = left.pop()
        if other not in reached:
            reached.add(other)
            left += included[other]
    return reached


def direct_arrows(included):
    """The arrows that do not follow from others."""
    return {room: {other for other in others
                   if not any(other in reached_from(middle, included) for middle in others - {other})}
            for room, others in included.items()}


def floors_of(included):
    """Rooms by floor, the lowest first: one above the highest room that it includes."""
    floor = {}

    def find(room):
        if room not in floor:
            floor[room] = 1 + max((find(other) for other in included[room]), default=-1)
        return floor[room]

    for room in included:
        find(room)
    return [sorted(room for room in floor if floor[room] == level) for level in range(max(floor.values()) + 1)]


def placed(floors, arrows):
    """The centre of every room's box; a floor's rooms stand above what they include."""
    width = max(len(floor) for floor in floors) * (BOX_WIDTH + GAP_X) + 2 * MARGIN
    centre = {}
    for level, floor in enumerate(floors):
        def wanted_x(room):
            below = [centre[other][0] for other in arrows[room] if other in centre]
            return sum(below) / len(below) if below else width / 2
        row = sorted(floor, key=lambda room: (wanted_x(room), room))
        start = (width - len(row) * (BOX_WIDTH + GAP_X) + GAP_X + BOX_WIDTH) / 2
        y = MARGIN + BOX_HEIGHT / 2 + (len(floors) - 1 - level) * (BOX_HEIGHT + GAP_Y)
        for i, room in enumerate(row):
            centre[room] = (start + i * (BOX_WIDTH + GAP_X), y)
    return centre, width, 2 * MARGIN + len(floors) * (BOX_HEIGHT + GAP_Y) - GAP_Y



def picture():
    included = rooms_and_includes()
    arrows = direct_arrows(included)
    centre, width, height = placed(floors_of(included), arrows)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
             'font-family="sans-serif" font-size="14" text-anchor="middle">',
             '<rect width="100%" height="100%" fill="#ffffff"/>',
             '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
             'orient="auto"><path d="M0 0 8 4 0 8z" fill="#8592a0"/></marker></defs>']
    for room, others in sorted(arrows.items()):
        for other in sorted(others):
            (x1, y1), (x2, y2) = centre[room], centre[other]
            parts.append(f'<path d="M{x1:.0f} {y1 + BOX_HEIGHT / 2:.0f} C{x1:.0f} {y1 + BOX_HEIGHT / 2 + 40:.0f} '
                         f'{x2:.0f} {y2 - BOX_HEIGHT / 2 - 40:.0f} {x2:.0f} {y2 - BOX_HEIGHT / 2:.0f}" fill="none" '
                         'stroke="#8592a0" stroke-width="1.2" marker-end="url(#tip)"/>')
    for room, (x, y) in sorted(centre.items()):
        parts.append(f'<rect x="{x - BOX_WIDTH / 2:.0f}" y="{y - BOX_HEIGHT / 2:.0f}" width="{BOX_WIDTH}" '
                     f'height="{BOX_HEIGHT}" rx="6" fill="#eaf1f7" stroke="#3b6ea5"/>')
        parts.append(f'<text x="{x:.0f}" y="{y + 5:.0f}" fill="#16324f">{html.escape(room)}</text>')
    return '\n'.join(parts) + '\n</svg>\n'


def main():
    drawn = picture()
    if sys.argv[1:] == ['--check']:
        if not PICTURE.exists() or PICTURE.read_text(encoding='utf-8') != drawn:
            print('docs/rooms.svg is not that of the includes; run scripts/draw_rooms.py', file=sys.stderr)
            return 1
        return 0
    if sys.argv[1:]:
        print('usage: scripts/draw_rooms.py [--check]', file=sys.stderr)
        return 2
    PICTURE.parent.mkdir(exist_ok=True)
    PICTURE.write_text(drawn, encoding='utf-8')
    return 0


if __name__ == '__main__':
    sys.exit(main())
