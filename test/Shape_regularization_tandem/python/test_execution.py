# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Back ends, threads, progress and signals."""

import signal
import threading
import time
import unittest

import numpy as np

import tandem
from clouds import MAXIMUM_DISTANCE, room, shapes_of_room


def detect(**arguments):
    return tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE, **arguments)


class Backends(unittest.TestCase):
    def test_all_have_the_same_result(self):
        for backend in tandem.backends():
            shapes = detect(backend=backend)
            self.assertEqual(shapes.statistics["backend"], backend)
            self.assertEqual(shapes.hash, shapes_of_room().hash)
        for threads in (1, 2, 10**6):
            self.assertEqual(detect(threads=threads).hash, shapes_of_room().hash)

    def test_what_is_not_there(self):
        for backend in {"parallel", "cuda"}.difference(tandem.backends()):
            with self.assertRaisesRegex(RuntimeError, f"^the back end {backend} cannot be used: "):
                detect(backend=backend)

    def test_calls_at_the_same_time(self):
        hashes = []
        callers = [threading.Thread(target=lambda: hashes.append(detect(threads=2).hash)) for _ in range(3)]
        for caller in callers:
            caller.start()
        for caller in callers:
            caller.join()
        self.assertEqual(hashes, 3 * [shapes_of_room().hash])

    def test_other_threads_run_meanwhile(self):
        is_over = threading.Event()
        ticks = []

        def tick():
            while not is_over.wait(0.001):
                ticks.append(time.perf_counter())

        clock = threading.Thread(target=tick)
        clock.start()
        start = time.perf_counter()
        tandem.detect_planes(*room(6000), backend="sequential")
        end = time.perf_counter()
        is_over.set()
        clock.join()
        self.assertGreater(sum(start < t < end for t in ticks), 5)


class Progress(unittest.TestCase):
    def test_it_rises_to_one_on_this_thread(self):
        for threads in (None, 1):
            reports, callers = [], set()

            def progress(share):
                reports.append(share)
                callers.add(threading.get_ident())

            self.assertEqual(detect(progress=progress, threads=threads).hash, shapes_of_room().hash)
            self.assertEqual((reports[0], reports[-1]), (0, 1))
            self.assertEqual(reports, sorted(reports))
            self.assertEqual(callers, {threading.get_ident()})

    def test_false_cancels(self):
        for last in (1, 3):
            reports = []

            def progress(share):
                reports.append(share)
                return np.bool_(len(reports) < last)

            shapes = detect(progress=progress)
            self.assertTrue(shapes.is_cancelled)
            self.assertEqual(len(reports), last)
            self.assertIn("cancelled", repr(shapes))
            self.assertIsNone(tandem.find_violation(room()[0], shapes))
        self.assertFalse(shapes_of_room().is_cancelled)

    def test_exceptions_are_passed_on(self):
        for last in (0, 0.2, 1):

            def progress(share):
                if share >= last:
                    raise KeyError(last)

            with self.assertRaises(KeyError) as caught:
                detect(progress=progress, threads=2)
            self.assertEqual(caught.exception.args, (last,))
        self.assertEqual(detect().hash, shapes_of_room().hash)

    def test_an_answer_without_a_truth_value(self):
        with self.assertRaisesRegex(ValueError, "ambiguous"):
            detect(progress=lambda share: np.array([True, False]))


@unittest.skipUnless(hasattr(signal, "setitimer"), "there are no timers")
class Signals(unittest.TestCase):
    def run_with_timer(self, handler, **arguments):
        cloud = room(6000)
        before = signal.signal(signal.SIGALRM, handler)
        signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
        try:
            return tandem.detect_planes(*cloud, **arguments)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)

    def test_they_are_handled_during_the_call(self):
        handled = []
        shapes = self.run_with_timer(lambda *_: handled.append(time.perf_counter()), backend="sequential")
        end = time.perf_counter()
        self.assertEqual(len(shapes), 6)
        self.assertGreater(end - handled[0], 0.001)

    def test_interrupts_end_the_call(self):
        def interrupt(*_):
            raise KeyboardInterrupt

        for arguments in ({}, {"progress": lambda share: True}, {"threads": 2}):
            with self.assertRaises(KeyboardInterrupt):
                self.run_with_timer(interrupt, **arguments)
        self.assertEqual(detect().hash, shapes_of_room().hash)


if __name__ == "__main__":
    unittest.main()
