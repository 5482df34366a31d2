# SPDX-License-Identifier: BSD-3-Clause
"""What becomes of a map is told, also over a connection that is lost."""
import asyncio
import threading

import pytest

import dhpmap
from dhpmap import _call
from dhpmap._watch import Watch
from dhpmap.v1 import watch_service_pb2 as pb2
from scripted_server import Wire

LABELS = [dhpmap.Label(1, "wall", "stuff"), dhpmap.Label(2, "chair")]


def rename(target, thing, name):
    with target.edit() as e:
        e.rename(thing, name)
    return e.revision


def test_a_change_is_told_with_the_object_as_it_is(apartment, sofa):
    with apartment.watch(objects=[sofa], after_revision=apartment.info.revision) as watch:
        revision = rename(apartment, sofa, "the sofa")
        change = next(watch)
        assert (change.kind, change.parts, change.revision) == ("changed", ("name",), revision)
        assert str(change) == f"revision {revision}: the sofa changed (name)"
    assert next(watch, None) is None


def test_only_what_passes_the_filter_is_told(apartment, sofa):
    lamp = apartment.find("lamp")[0]
    with apartment.watch(classes=["lamp"], after_revision=apartment.info.revision) as watch:
        rename(apartment, sofa, "not asked for")
        rename(apartment, lamp, "asked for")
        assert next(watch).object.id == lamp.id


def test_a_watch_ends_when_nothing_is_told_for_so_long(apartment):
    assert list(apartment.watch(idle_s=0.05)) == []


def test_a_watch_goes_on_after_a_lost_connection_without_a_gap(server, apartment, sofa, monkeypatch):
    monkeypatch.setattr(_call, "FIRST_PAUSE_S", 0.001)
    with Wire(server.address) as wire, dhpmap.connect(wire.address) as connection:
        with connection["apartment"].watch(objects=[sofa], after_revision=apartment.info.revision) as watch:
            rename(apartment, sofa, "one")
            assert next(watch).object.name == "one"
            wire.cut()
            rename(apartment, sofa, "two")
            rename(apartment, sofa, "three")
            wire.mend()
            assert [next(watch).object.name, next(watch).object.name] == ["two", "three"]
        assert wire.num_connections >= 2


def test_changes_come_by_asyncio_while_others_run(apartment, sofa):
    async def watch_and_rename():
        watch = apartment.watch(objects=[sofa], after_revision=apartment.info.revision)
        names = ["first", "second"]
        renamed = asyncio.create_task(asyncio.to_thread(rename, apartment, sofa, names[0]))
        told = []
        async for change in watch:
            told.append(change.object.name)
            if len(told) == 1:
                await renamed
                await asyncio.to_thread(rename, apartment, sofa, names[1])
            else:
                watch.close()
        return told, await anext(apartment.watch(idle_s=0.01), "nothing")

    assert asyncio.run(watch_and_rename()) == (["first", "second"], "nothing")


def test_a_task_that_is_cancelled_closes_its_watch(apartment):
    async def cancel():
        watch = apartment.watch(classes=["lamp"])
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(anext(watch), 0.01)
        return watch

    assert next(asyncio.run(cancel()), "closed") == "closed"  # which ends: no thread waits on


def test_another_thread_may_end_a_watch(apartment):
    watch = apartment.watch(classes=["lamp"])
    told = []
    reader = threading.Thread(target=lambda: told.extend(watch))
    reader.start()
    watch.close()
    reader.join(20)
    assert not reader.is_alive() and told == []


def test_a_watch_of_a_map_that_is_deleted_ends_with_an_error(connection):
    made = connection.create("short_lived", LABELS)
    watch = made.watch(after_revision=made.info.revision)
    connection.delete("short_lived")
    with pytest.raises(dhpmap.NotFound):
        next(watch)


def told_in_parts(*messages):
    """What a watch makes of messages, each (ids of objects, position, whether it is the last of its revision)."""
    watch = Watch(None, pb2.WatchMapRequest(), reconnect_s=0, idle_s=None)
    out = []
    for ids, position, is_last in messages:
        message = pb2.WatchMapResponse(position=position)
        message.change.first_revision = message.change.last_revision = 7
        message.change.last_message = is_last
        for number in ids:
            message.change.submaps.add(kind=pb2.SubmapEvent.CREATED).submap.instance_id = number
        watch._take(message)
        out.append(([change.object.id for change in watch._told], watch.revision, watch._position))
    return out


def test_a_change_in_several_messages_is_told_once_it_is_whole():
    assert told_in_parts(([1, 2], "h-6", False), ([3], "h-7", True)) == [([], 0, "h-6"), ([1, 2, 3], 7, "h-7")]


def test_a_watch_that_nobody_holds_any_longer_ends_its_call(apartment):
    watch = apartment.watch(classes=["lamp"], idle_s=0.05)
    watch._start()
    call, ended = watch._call, threading.Event()
    call.add_callback(ended.set)
    del watch
    assert ended.wait(20)
