# SPDX-License-Identifier: BSD-3-Clause
"""Edits, undo and the past."""
import numpy as np
import pytest

import dhpmap


@pytest.fixture
def copy(connection, apartment, tmp_path):
    """A map of this test alone."""
    apartment.export(tmp_path / "apartment.dhpmap")
    made = connection.import_map(tmp_path / "apartment.dhpmap", "copy")
    yield made
    connection.delete("copy")


def test_a_list_of_edits_is_one_revision_and_undo_takes_it_back(copy):
    sofa, chair = copy.find("sofa")[0], copy.find("chair")[0]
    with copy.edit(author="anna") as e:
        e.move(sofa, by_m=(1, 0, 0))
        again = e.clone(chair, name="another")
        e.move(again, by_m=(0, 0, 1))
    assert copy.info.revision == e.revision and e.results[0].changed == (sofa.id,)
    made = copy.objects[e.results[1].created[0]]
    assert made.name == "another"
    went_m = copy.objects[sofa.id].T_map_object[:3, 3] - sofa.T_map_object[:3, 3]
    np.testing.assert_allclose(went_m, (1, 0, 0), atol=1e-9)
    assert copy.undo().edits == (e.revision,)  # of anna, who edited last
    assert made.id not in copy.objects
    np.testing.assert_allclose(copy.objects[sofa.id].T_map_object, sofa.T_map_object)
    assert copy.redo().edits == (e.revision,) and made.id in copy.objects


def test_an_exception_within_the_block_does_nothing(copy):
    sofa, revision = copy.find("sofa")[0], copy.info.revision
    with pytest.raises(RuntimeError):
        with copy.edit() as e:
            e.delete(sofa)
            raise RuntimeError
    assert copy.info.revision == revision and sofa in copy.objects


def test_a_list_with_one_bad_edit_does_nothing_and_names_it(copy):
    sofa, revision = copy.find("sofa")[0], copy.info.revision
    with pytest.raises(dhpmap.NotFound, match=r"edits\[1\]"):
        with copy.edit() as e:
            e.delete(sofa)
            e.delete(10**6)
    assert copy.info.revision == revision and sofa in copy.objects


def test_a_preview_changes_nothing(copy):
    sofa, revision = copy.find("sofa")[0], copy.info.revision
    with pytest.raises(StopIteration):
        with copy.edit() as e:
            e.delete(sofa)
            assert e.preview()[0].removed == (sofa.id,)
            raise StopIteration
    assert copy.info.revision == revision


def test_an_object_that_somebody_has_edited_since_is_left_alone(copy):
    sofa = copy.find("sofa")[0]
    with copy.edit(author="bob") as e:
        e.rename(sofa, "the red one")
    with pytest.raises(dhpmap.Aborted, match="ETAG_MISMATCH"):
        with copy.edit(only_if_unedited=True) as e:
            e.delete(sofa)
    assert copy.find(name="red")[0].id == sofa.id


def test_every_kind_of_edit_reaches_the_map(copy):
    sofa, table, cup = copy.find("sofa")[0], copy.find("coffee table")[0], copy.find("lamp")[0]
    with copy.edit(author="anna") as e:
        e.move(sofa, turn_rad=0.5)
        e.place(cup, on=table)
        e.relabel(cup, "vase")
        e.lock(table)
        e.set_present(sofa, False)
        e.ignore_region("door", dhpmap.Box((0, 0, 0), (0.5, 0.5, 0.5)))
    assert copy.objects[cup].class_name == "vase" and copy.objects[table].is_locked
    assert not copy.objects[sofa].is_present and set(copy.ignored_regions) == {"door"}
    placed = copy.objects[cup].box
    np.testing.assert_allclose(placed.center_m[:2], table.box.center_m[:2], atol=0.1)
    with copy.edit() as e:
        e.unlock(table)
        e.unignore_region("door")
        e.move(sofa, to=np.eye(4))
    assert copy.ignored_regions == {}
    with copy.edit() as e:
        e.clear(dhpmap.Sphere(table.box.center_m, 2), thing=table)
    assert e.results[0].removed == (table.id,) and e.results[0].num_voxels > 100
    with copy.edit() as e:
        parts = e.split(sofa, dhpmap.Plane(copy.objects[sofa].box.center_m, (1, 0, 0)))
        e.merge(sofa, [parts])
    assert e.results[0].created == e.results[1].removed


def test_the_log_tells_who_did_what(copy):
    sofa = copy.find("sofa")[0]
    with copy.edit(author="anna") as e:
        e.move(sofa, by_m=(0, 1, 0))
    copy.undo()
    undo, edit = list(copy.log())[:2]
    assert (undo.kind, edit.kind, edit.author, edit.actions) == ("undo", "edit", "anna", ("move",))
    assert edit.revision == e.revision and edit.is_undone and edit.changed == (sofa.id,) and edit.time.tzinfo
    assert [its.author for its in copy.log(author="nobody")] == []


def test_the_past_is_as_it_was(copy):
    sofa, before = copy.find("sofa")[0], copy.info.revision
    at = sofa.box.center_m
    with copy.edit() as e:
        e.delete(sofa)
    past = copy.at(before)
    assert past.objects[sofa.id].name == sofa.name and past.distances(at).object_id == sofa.id
    assert {its.revision for its in copy.revisions()} >= {before, e.revision}
    assert past.distances(at).revision == before and copy.distances(at).object_id != sofa.id
    assert past.slice(0.1, 1, include_objects=True).object_id.max() > 0
    assert copy.restore(before, sofa).created == (sofa.id,)
    with pytest.raises(dhpmap.InvalidArgument, match="BAD_REVISION"):
        copy.at(10**6).distances(at)


def test_a_map_is_exported_imported_renamed_verified_and_deleted(connection, copy, apartment):
    assert copy.info.num_objects == apartment.info.num_objects and "copy" in connection
    copy.set_title("The copy")
    assert str(copy).startswith("The copy: ") and copy.verify()
    assert copy.stats().num_things + copy.stats().num_stuff == copy.info.num_objects and copy.stats().disk_bytes > 10**5
    with pytest.raises(dhpmap.AlreadyExists):
        connection.create("copy")
