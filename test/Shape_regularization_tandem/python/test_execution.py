# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Back ends, threads, progress and signals."""

import signal
import threading
import time

import numpy as np
import pytest

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def detect(**arguments):
    return tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE, **arguments)


def test_all_have_the_same_result_or_are_not_there():
    for backend in tandem.backends():
        shapes = detect(backend=backend)
        assert shapes.statistics["backend"] == backend
        assert shapes.hash == shapes_of_room().hash
    for threads in (1, 2, 10**6):
        assert detect(threads=threads).hash == shapes_of_room().hash
    for backend in {"parallel", "cuda"}.difference(tandem.backends()):
        with pytest.raises(RuntimeError, match=f"^the back end {backend} cannot be used: "):
            detect(backend=backend)


def test_other_threads_run_meanwhile():
    is_over, ticks, hashes = threading.Event(), [], []

    def tick():
        while not is_over.wait(0.001):
            ticks.append(time.perf_counter())

    clock = threading.Thread(target=tick)
    callers = [threading.Thread(target=lambda: hashes.append(detect(threads=2).hash)) for _ in range(3)]
    for thread in (clock, *callers):
        thread.start()
    shapes, spans = shapes_of_room(), []
    for call in (lambda: tandem.detect_planes(*room(6000), backend="sequential"), shapes.polygons, shapes.closed_surface):
        start = time.perf_counter()
        call()
        spans.append((start, time.perf_counter()))
    is_over.set()
    for thread in (clock, *callers):
        thread.join()
    assert all(sum(start < t < end for t in ticks) > 5 for start, end in spans) and hashes == 3 * [shapes_of_room().hash]


def test_it_rises_to_one_on_this_thread():
    for threads in (None, 1):
        reports, callers = [], set()

        def progress(fraction):
            reports.append(fraction)
            callers.add(threading.get_ident())

        assert detect(progress=progress, threads=threads).hash == shapes_of_room().hash
        assert (reports[0], reports[-1]) == (0, 1) and reports == sorted(reports)
        assert callers == {threading.get_ident()}


def test_false_cancels():
    reports = []

    def progress(fraction):
        reports.append(fraction)
        return np.bool_(len(reports) < 3)

    shapes = detect(progress=progress)
    assert shapes.is_cancelled and not shapes_of_room().is_cancelled
    assert len(reports) == 3 and "cancelled" in repr(shapes)
    assert tandem.find_violation(room()[0], shapes) is None


def test_exceptions_are_passed_on():
    for last in (0, 0.2, 1):

        def progress(fraction):
            if fraction >= last:
                raise KeyError(last)

        with pytest.raises(KeyError) as caught:
            detect(progress=progress, threads=2)
        assert caught.value.args == (last,)
    with pytest.raises(ValueError, match="ambiguous"):
        detect(progress=lambda fraction: np.array([True, False]))
    assert detect().hash == shapes_of_room().hash


def run_with_timer(handler, **arguments):
    cloud = room(6000)
    before = signal.signal(signal.SIGALRM, handler)
    signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
    try:
        return tandem.detect_planes(*cloud, **arguments)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_they_are_handled_during_the_call():
    handled = []
    assert len(run_with_timer(lambda *_: handled.append(time.perf_counter()), backend="sequential")) == 6
    assert time.perf_counter() - handled[0] > 0.001


def test_interrupts_end_the_call():
    def interrupt(*_):
        raise KeyboardInterrupt

    for arguments in ({}, {"progress": lambda fraction: True}, {"threads": 2}):
        with pytest.raises(KeyboardInterrupt):
            run_with_timer(interrupt, **arguments)
    assert detect().hash == shapes_of_room().hash
