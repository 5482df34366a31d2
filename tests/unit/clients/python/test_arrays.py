# SPDX-License-Identifier: BSD-3-Clause
"""Long lists of numbers between numpy and bytes: as protobuf itself has them."""
import numpy as np
import pytest
from google.protobuf.message import DecodeError

from dhpmap import _geometry, _wire
from dhpmap.v1 import query_service_pb2 as pb2

PACKED = pb2.PackedDistanceResults.DESCRIPTOR


def test_columns_are_what_protobuf_reads():
    random = np.random.default_rng(3)
    ids = random.integers(-2**63, 2**63, 1000) >> random.integers(0, 64, 1000)  # of every length of a varint
    message = pb2.PackedDistanceResults(distance_m=random.normal(size=1000), instance_id=ids.tolist(),
                                        class_id=random.integers(-2**31, 2**31, 1000).tolist(),
                                        status=[1, 2, 3, 1] * 250)
    columns = _wire.read_columns(memoryview(message.SerializeToString()), PACKED)
    np.testing.assert_array_equal(columns["distance_m"], np.array(message.distance_m, np.float32))
    for name in ("instance_id", "class_id", "status"):
        np.testing.assert_array_equal(columns[name], np.array(getattr(message, name)))
    assert columns["gradient"].size == 0


def test_lists_that_come_in_pieces_or_number_by_number_are_read_alike():
    pieces = [pb2.PackedDistanceResults(instance_id=part).SerializeToString() for part in ([1, 300], [70000])]
    one_by_one = b"".join(_wire.varint(4 << 3) + _wire.varint(number) for number in (1, 300, 70000))
    for data in (b"".join(pieces), one_by_one):
        assert _wire.read_columns(memoryview(data), PACKED)["instance_id"].tolist() == [1, 300, 70000]


def test_floats_are_written_as_protobuf_reads_them():
    values = np.random.default_rng(4).normal(size=(100, 3)).astype(np.float32)
    field = pb2.QueryDistancesRequest.DESCRIPTOR.fields[1].name  # the packed points
    for array in (values, np.asfortranarray(values), values[::-1]):
        data = b"\x0a\x01a" + _wire.floats_field(pb2.QueryDistancesRequest.DESCRIPTOR, field, array)
        message = pb2.QueryDistancesRequest.FromString(data)
        assert message.map == "a"
        np.testing.assert_array_equal(np.array(getattr(message, field), np.float32), array.ravel())


def test_bytes_that_are_cut_off_are_an_error_wherever_it_is():
    data = pb2.PackedDistanceResults(distance_m=[1, 2], instance_id=[300, 7]).SerializeToString()
    ends = {0, data.index(b"\x22")}  # between fields
    for length in set(range(len(data))) - ends:
        with pytest.raises((DecodeError, ValueError)):
            _wire.read_columns(memoryview(data[:length]), PACKED)
    with pytest.raises(DecodeError):
        _wire.read_varints(memoryview(b"\x80" * 20))


def test_a_mesh_holds_the_surface_that_distances_are_measured_to(apartment, sofa):
    mesh = apartment.mesh(sofa)
    assert len(mesh.vertices_m) > 1000 and mesh.triangles.max() < len(mesh.vertices_m) and mesh.triangles.min() == 0
    assert (mesh.object_id == sofa.id).all() and (mesh.class_id == sofa.class_id).all()
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-3)
    some = apartment.distances(mesh.vertices_m[::20], classes=["sofa"])
    assert np.abs(some.distance_m).max() < 0.01
    with pytest.raises(DecodeError, match="cut off"):
        _geometry.mesh_of_ply(mesh.ply[:-1], 1)
    whole = apartment.mesh()
    assert set(np.unique(whole.object_id)) > {sofa.id} and whole.revision == mesh.revision


def test_voxels_lie_where_the_object_is(apartment, sofa, tmp_path):
    voxels = apartment.voxels(sofa)
    near = apartment.voxels(sofa, max_abs_tsdf_m=0.04)
    assert 0 < len(near) < len(voxels) and np.abs(near.tsdf_m).max() <= 0.04 + 1e-6
    assert (np.linalg.norm(voxels.center_m - sofa.center_m, axis=1) < sofa.radius_m + 0.1).all()
    assert voxels.rgb.shape == (len(voxels), 3)


def test_a_grid_has_the_distances_of_its_nodes(apartment):
    from dhpmap import Box
    grid = apartment.distance_grid(Box((1, 1, 0.2), (2, 2.2, 0.8)), 0.2, include_gradients=True, include_objects=True)
    assert grid.distance_m.shape == (6, 7, 4) and grid.gradient.shape == (6, 7, 4, 3)
    nodes = grid.origin_m + 0.2 * np.stack(np.meshgrid(*map(np.arange, (6, 7, 4)), indexing="ij"), axis=-1)
    d = apartment.distances(nodes)
    np.testing.assert_allclose(grid.distance_m, d.distance_m, atol=1e-5)
    np.testing.assert_array_equal(grid.known, d.known)
    np.testing.assert_array_equal(grid.object_id, d.object_id)


def test_a_slice_is_occupied_where_a_ball_collides_and_saved_for_nav2(apartment, sofa, tmp_path):
    cut = apartment.slice(0.1, 1.2, include_objects=True)
    x, y = ((sofa.box.center_m - cut.origin_m)[:2] / cut.resolution_m).astype(int)
    assert sofa.id in cut.object_id[y - 10:y + 10, x - 10:x + 10]
    assert ((cut.object_id >= 0) == cut.occupied).all() and cut.free.sum() > 1000
    cut.save(tmp_path / "floor")
    assert (tmp_path / "floor.pgm").read_bytes().startswith(b"P5\n%d %d\n255\n" % cut.cells.shape[::-1])
    assert "image: floor.pgm" in (tmp_path / "floor.yaml").read_text()


def test_a_loop_answers_as_calls_do_and_keeps_to_a_pinned_state(apartment, sofa):
    import dhpmap
    with apartment.loop() as loop:
        revision = loop.pin()
        with apartment.edit() as e:
            e.move(sofa, by_m=(0, 0, 2))
        at = sofa.box.center_m
        assert loop.distances(at).object_id == sofa.id and loop.distances(at).revision == revision
        with pytest.raises(dhpmap.InvalidArgument, match="did you mean 'sofa'"):
            loop.find("sofaa")
        loop.unpin()
        assert loop.distances(at).revision == e.revision and loop.distances(at).object_id != sofa.id
        apartment.undo()
        assert loop.find("sofa")[0].id == sofa.id
