#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the nearest chair and a way to it: clients/python/examples/path_to_chair.py [ADDRESS [MAP [X Y]]]"""
import heapq
import sys

import numpy as np

import dhpmap

RADIUS_M, Z_M = 0.25, 0.35  # the robot is a ball that floats over the floor


def way(is_free, start, goals):
    """Dijkstra over cells and their eight neighbours; the cells of the way, or none."""
    cost, before, queue = {start: 0.0}, {}, [(0.0, start)]
    while queue:
        so_far, cell = heapq.heappop(queue)
        if goals[cell]:
            cells = [cell]
            while cells[-1] != start:
                cells.append(before[cells[-1]])
            return cells[::-1]
        for step in ((0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)):
            near = cell[0] + step[0], cell[1] + step[1]
            to_there = so_far + np.hypot(*step)
            if all(0 <= axis < size for axis, size in zip(near, is_free.shape)) and is_free[near] \
                    and to_there < cost.get(near, np.inf):
                cost[near], before[near] = to_there, cell
                heapq.heappush(queue, (to_there, near))
    return []


def main(address="localhost:50051", name="apartment", x="5.2", y="2.6"):
    m = dhpmap.connect(address)[name]
    start = np.array([float(x), float(y), Z_M])
    robot = dhpmap.Spheres([(0, 0, 0, RADIUS_M)])
    floor = m.slice(Z_M - RADIUS_M, Z_M + RADIUS_M, resolution_m=0.08)
    places = floor.places(Z_M)
    is_free = ~m.collisions(np.concatenate([places, np.full((*places.shape[:2], 1), RADIUS_M)], axis=-1)).colliding
    for chair in m.find("chair", near=start):
        goals = is_free & (np.linalg.norm(places[..., :2] - chair.box.center_m[:2], axis=-1) < 0.9)
        cells = way(is_free, floor.cell_of(start), goals)
        path = [start, *(places[cell] for cell in cells)]
        if cells and (check := m.check_path(robot, path, include_clearance=True)):
            length_m = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
            print(f"to {chair}: {len(path)} waypoints, {length_m:.1f} m, {check.clearance.distance_m:.2f} m clear")
            return path
        print(f"no way to {chair}" if not cells else f"the way to {chair} is blocked by {check.contact.object}")
    return []


if __name__ == "__main__":
    sys.exit(0 if len(main(*sys.argv[1:])) else 1)
