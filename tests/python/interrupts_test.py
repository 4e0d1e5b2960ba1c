import signal
import sys
import unittest
from unittest import mock

import numpy as np
import pt
from pictures import SCENE, WHITE, cloud, ready

ENDLESS = 2**20  # takes minutes on CPUs
MANY = 300_000


class Alarm(Exception):
    pass


def many_spheres():
    return pt.Scene(sphere_arrays=[pt.SphereArray(cloud(MANY)[0], 1e-3, WHITE)])


def ring(_signal, _frame):
    raise Alarm


class Interrupts(unittest.TestCase):
    def setUp(self):
        signal.signal(signal.SIGINT, signal.default_int_handler)  # Shells let background jobs ignore SIGINT.
        signal.signal(signal.SIGALRM, ring)
        self.context = ready(pt.Context(submit_milliseconds=1))
        self.addCleanup(self.context.close)
        self.addCleanup(signal.setitimer, signal.ITIMER_REAL, 0)
        self.hook = sys.unraisablehook

    def tearDown(self):
        self.assertIs(sys.unraisablehook, self.hook)

    def check_usable(self):
        ready(self.context)
        self.context.accumulate(8)
        with pt.Context() as fresh:
            ready(fresh).accumulate(8)
            np.testing.assert_array_equal(self.context.readback(), fresh.readback())

    def test_true_alone_stops(self):
        self.context.accumulate(4)
        film = self.context.film()
        self.assertIs(self.context.set_scene(many_spheres(), lambda _: True), pt.Result.CANCELLED)
        self.assertEqual(self.context.film(), film)
        told = []
        self.assertIs(self.context.accumulate(ENDLESS, progress=lambda _: told.append(_) or len(told) > 3),
                      pt.Result.CANCELLED)
        self.assertEqual(len(told), 4)
        for value in 1, "stop":
            self.assertIs(self.context.set_scene(many_spheres(), lambda _: value), pt.Result.OK)

    def test_what_progress_raises(self):
        fail = mock.Mock(side_effect=LookupError("where it is"))
        for error, words, progress in (LookupError, "where it is", fail), (KeyboardInterrupt, "", lambda _: signal.raise_signal(signal.SIGINT)):
            self.context.accumulate(4)
            film = self.context.film()
            with self.assertRaisesRegex(error, words):
                self.context.set_scene(many_spheres(), progress)
            self.assertEqual(self.context.film(), film)
            with self.assertRaisesRegex(error, words):
                self.context.accumulate(ENDLESS, progress=progress)
            self.check_usable()
        with self.assertRaises(LookupError):
            pt.Context(log=fail)

    def test_a_signal_while_samples_are_taken(self):
        """The signal's exception must also be raised without a progress function."""
        for _ in range(3):
            with self.assertRaises(Alarm):
                signal.setitimer(signal.ITIMER_REAL, 0.02)
                self.context.accumulate(ENDLESS)
            self.check_usable()

    def test_what_others_cannot_raise_goes_its_way(self):
        told = []
        sys.unraisablehook, hook = lambda raised: told.append(raised.exc_type), sys.unraisablehook

        class Failing:
            def __del__(self):
                raise LookupError

        self.assertIs(self.context.accumulate(1, progress=lambda _: Failing() and None), pt.Result.OK)
        sys.unraisablehook = hook
        self.assertEqual(set(told), {LookupError})
