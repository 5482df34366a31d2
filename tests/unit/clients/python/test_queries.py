# SPDX-License-Identifier: BSD-3-Clause
"""Queries of a map: arrays in, columns out."""
import numpy as np
import pytest

import dhpmap
from dhpmap import _columns


def points_around(m, count=500):
    return np.random.default_rng(7).uniform((0, 0, 0), (11, 8, 2.5), (count, 3))


def test_distances_come_in_the_shape_of_the_points(apartment):
    points = points_around(apartment).reshape(10, 50, 3)
    d = apartment.distances(points)
    assert d.distance_m.shape == d.object_id.shape == d.known.shape == (10, 50)
    assert d.gradient.shape == d.nearest_point_m.shape == (10, 50, 3)
    flat = apartment.distances(points.reshape(-1, 3))
    np.testing.assert_array_equal(flat.distance_m, d.distance_m.ravel())


def test_the_nearest_point_is_as_far_as_the_distance_says(apartment):
    points = points_around(apartment)
    d = apartment.distances(points)
    met = ~d.clamped
    assert met.sum() > 100
    np.testing.assert_allclose(np.linalg.norm(d.nearest_point_m[met] - points[met], axis=1),
                               np.abs(d.distance_m[met]), atol=1e-4)
    assert np.isnan(d.nearest_point_m[d.clamped]).all() and (d.object_id[d.clamped] == -1).all()


def test_distances_are_those_that_messages_tell(apartment, server):
    import grpc
    from dhpmap.v1 import query_service_pb2, query_service_pb2_grpc, types_pb2
    points = points_around(apartment, 50)
    d = apartment.distances(points)
    with grpc.insecure_channel(server.address) as channel:
        stub = query_service_pb2_grpc.QueryServiceStub(channel)
        told = stub.QueryDistances(query_service_pb2.QueryDistancesRequest(
            map="maps/apartment", points_m=[types_pb2.Vector3(x=x, y=y, z=z) for x, y, z in points.tolist()]))
    np.testing.assert_allclose([its.distance_m for its in told.results], d.distance_m, atol=1e-5)
    assert [its.instance_id for its in told.results] == d.object_id.tolist()
    assert [its.status for its in told.results] == d.status.tolist()
    assert told.revision == d.revision


def test_an_ignored_object_is_no_longer_the_nearest(apartment, sofa):
    inside = sofa.box.center_m
    assert apartment.distances(inside).object_id == sofa.id
    for ignored in ([sofa], [sofa.id], [np.int64(sofa.id)], [dhpmap.Ref(sofa.id)], ["sofa"]):
        d = apartment.distances(inside, ignore=ignored)
        assert d.object_id != sofa.id and d.distance_m > 0


def test_more_points_than_a_call_takes_are_asked_in_several_of_one_revision(apartment, monkeypatch):
    points = points_around(apartment)
    whole = apartment.distances(points)
    monkeypatch.setattr(_columns, "MOST_ROWS_A_CALL", 120)
    parts = apartment.distances(points)
    np.testing.assert_array_equal(parts.distance_m, whole.distance_m)
    np.testing.assert_array_equal(parts.object_id, whole.object_id)


def test_no_points_are_answered_by_none(apartment):
    d = apartment.distances(np.empty((0, 3)))
    assert d.distance_m.shape == (0,) and d.gradient.shape == (0, 3) and d.revision > 0


def test_a_frame_of_ones_own_turns_points_and_answers(apartment):
    T_map_query = dhpmap.pose(3, 2, 0.5, yaw_rad=0.7)
    points = points_around(apartment, 50)
    own = (points - T_map_query[:3, 3]) @ T_map_query[:3, :3]
    plain, turned = apartment.distances(points), apartment.distances(own, T_map_query=T_map_query)
    np.testing.assert_allclose(turned.distance_m, plain.distance_m, atol=1e-3)
    np.testing.assert_allclose(turned.gradient @ T_map_query[:3, :3].T, plain.gradient, atol=2e-2)


def test_a_ray_down_meets_the_sofa_and_its_free_way_ends_there(apartment, sofa):
    above = sofa.box.center_m + (0, 0, 1.2)
    rays = apartment.rays(above, [(0, 0, -1), (0, 0, -5)])
    assert rays.object_id.tolist() == [sofa.id, sofa.id] and rays.hit.all() and rays.known.all()
    np.testing.assert_allclose(rays.distance_m[0], rays.distance_m[1])
    np.testing.assert_allclose(rays.point_m[0], above - (0, 0, rays.distance_m[0]), atol=1e-4)


def test_points_tell_surface_free_and_unknown_apart(apartment, sofa):
    top = apartment.rays(sofa.box.center_m + (0, 0, 1.2), (0, 0, -1)).point_m
    p = apartment.points([top, sofa.box.center_m + (0, 0, 1.2), (100, 100, 100)])
    assert p.near_surface.tolist() == [True, False, False]
    assert p.free.tolist() == [False, True, False]
    assert p.known.tolist() == [True, True, False]
    assert p.object_id[0] == sofa.id and p.rgb.shape == (3, 3)
    assert np.isnan(p.tsdf_m[1])


def test_spheres_boxes_and_capsules_collide_alike(apartment, sofa):
    at = sofa.box.center_m
    columns = apartment.collisions([(*at, 0.3), (*at + (0, 0, 1.3), 0.1)], unknown="free")
    assert columns.colliding.tolist() == [True, False]
    assert columns.object_id.tolist() == [sofa.id, -1] and columns.depth_m[0] > 0.1
    bodies = [dhpmap.Sphere(at, 0.3), dhpmap.Box(at - 0.2, at + 0.2), dhpmap.Capsule(at, at + (0, 0, 0.1), 0.2),
              sofa.box]
    checks = apartment.check_bodies(bodies)
    assert all(checks) and all(check.contacts[0].object.id == sofa.id for check in checks[:3])
    assert not apartment.collisions((*at, 0.3), ignore=[sofa], unknown="free").colliding \
        or apartment.collisions((*at, 0.3), ignore=[sofa], unknown="free").object_id != sofa.id


def test_a_path_through_the_sofa_names_it_and_where(apartment, sofa):
    robot = dhpmap.Spheres([(0, 0, 0, 0.2)], may_touch=["floor", "rug"])
    x, y, z = sofa.box.center_m
    path = [(x, y, z + 1.2), (x, y, z)]
    check = apartment.check_path(robot, path, unknown="free")
    assert not check and check.contact.object.id == sofa.id and check.contact.waypoint == 0
    assert str(check.contact.object) == f"sofa {sofa.id}"
    assert 0 < check.contact.fraction < 1 and z - 0.2 < check.contact.point_m[2] < z + 1.2
    excused = apartment.check_path(robot, path, unknown="free", may_touch=[sofa, "cushion"], include_clearance=True)
    assert excused.ok and excused.contact is None and excused.clearance.object.id != sofa.id


def test_waypoints_as_places_quaternions_and_matrices_are_one_path(apartment):
    robot = dhpmap.Spheres([(0, 0, 0.3, 0.25)])
    places = np.array([(5, 2, 0.1), (2, 2, 0.1)])
    quaternions = np.hstack([places, np.tile((0, 0, 0, 1), (2, 1))])
    matrices = np.stack([dhpmap.pose(*place) for place in places])
    fractions = {apartment.check_path(robot, path).contact.fraction for path in (places, quaternions, matrices)}
    assert len(fractions) == 1


def test_several_paths_are_checked_as_one_by_one(apartment):
    robot = dhpmap.Spheres([(0, 0, 0.5, 0.2)])
    paths = [[(5, 2, 0), (2, 2, 0)], [(2, 1.2, 0.8), (2.1, 1.2, 0.8)]]
    together = apartment.check_paths(robot, paths, include_clearance=True)
    assert [check.ok for check in together] == [apartment.check_path(robot, path).ok for path in paths]
    assert together[0].clearance.distance_m < 0 and together[0].clearance.object.id >= 0


def test_find_puts_the_nearest_first(apartment):
    near = (2, 2, 0)
    found = apartment.find("chair", near=near)
    assert len(found) > 1 and [its.class_name for its in found] == ["chair"] * len(found)
    gaps = [its.distance_m for its in found]
    assert gaps == sorted(gaps)
    np.testing.assert_allclose(np.linalg.norm(found[0].nearest_point_m - near), gaps[0], atol=1e-6)
    assert apartment.find("chair", near=near, limit=1) == found[:1]


def test_an_object_found_is_the_object_got(apartment, sofa):
    got = apartment.objects[sofa.id]
    assert got == sofa and hash(got) == hash(sofa) and sofa in apartment.objects
    assert 10**6 not in apartment.objects
    assert (got.box.size_m > 0.3).all() and got.kind == "thing" and got.last_seen_ns > got.first_seen_ns
    assert {its.id for its in apartment.objects} >= {0, sofa.id}
    with pytest.raises(ValueError, match="read-only"):
        got.T_map_object[0, 3] = 1


def test_relations_name_what_stands_on_what(apartment, sofa):
    on = apartment.relations("on", of=sofa)
    assert any(its.subject.id == sofa.id for its in on) and all(its.kind == "on" for its in on)
    assert f"{sofa} on " in str(on[0]) or str(on[0]).endswith(f" on {sofa}")
