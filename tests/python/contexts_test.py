import gc
import os
import pathlib
import resource
import signal
import sys
import threading
import unittest
import weakref
from unittest import mock

import numpy as np
import pt
from pictures import CAMERA, SCENE, WHITE, cloud, ready, settings
from pt import _context, _library

ENDLESS = 2**20  # takes minutes on CPUs
MANY_SPHERES = pt.Scene(sphere_arrays=[pt.SphereArray(cloud(300_000)[0], 1e-3, WHITE)])


class Lives(unittest.TestCase):
    def setUp(self):
        self.destroyed = []
        self.enterContext(mock.patch.object(_context, "_destroy", self.destroy))

    def destroy(self, loaded, handle, log):
        self.destroyed.append(handle.value)
        loaded.pt_destroy(handle)

    def test_closed_once(self):
        with pt.Context() as context:
            self.assertEqual(len(self.destroyed), 0)
            self.assertIn(context.device.name, repr(context))
        context.close()
        self.assertEqual(len(self.destroyed), 1)
        self.assertEqual(repr(context), "<pt.Context, closed>")
        for call in context.stats, context.prepare, lambda: context.set_scene(SCENE):
            with self.assertRaisesRegex(pt.InvalidStateError, "the context is closed"):
                call()

    def test_forgotten_with_a_log_that_refers_to_it(self):
        class Owner:
            def __init__(self):
                self.lines = []
                self.context = pt.Context(log=self.write)

            def write(self, level, line):
                self.lines.append((level, line))

        owner = Owner()
        ready(owner.context).accumulate(1)
        self.assertIn(pt.LogLevel.INFO, [level for level, _ in owner.lines])
        self.assertTrue(all(line and isinstance(line, str) for _, line in owner.lines))
        gone = weakref.ref(owner)
        del owner
        gc.collect()
        self.assertIsNone(gone())
        self.assertEqual(len(self.destroyed), 1)

    def test_nothing_is_left_of_films(self):
        with pt.Context() as context:
            context.render(SCENE, CAMERA, settings(width=300, height=300), 1)
            film = context.film()
            before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
            for _ in range(50):
                film = pt.Film(film.to_bytes())
            self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 10 * 10_000)

    def test_arrays_of_a_scene_are_not_kept(self):
        positions = np.zeros((100, 3))
        gone = weakref.ref(positions)
        with pt.Context() as context:
            context.set_scene(pt.Scene(sphere_arrays=[pt.SphereArray(positions, 1, pt.Material())]))
            del positions
            self.assertIsNone(gone())


class Calls(unittest.TestCase):
    def test_a_child_leaves_its_parent_s_alone(self):
        context = ready(pt.Context())
        context.accumulate(1)
        child = os.fork()
        if child == 0:
            signal.alarm(600)
            status = 1
            try:
                context.stats()
            except pt.InvalidStateError as error:
                status = 0 if "forked" in str(error) else 2
            context.close()
            del context
            gc.collect()
            os._exit(status)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)
        context.accumulate(1)
        context.close()

    def test_others_run_during_calls(self):
        interval = sys.getswitchinterval()
        self.addCleanup(sys.setswitchinterval, interval)
        start, ran = threading.Event(), []
        thread = threading.Thread(target=lambda: (start.wait(), ran.append(True)), daemon=True)
        thread.start()
        with ready(pt.Context(submit_milliseconds=1)) as context:
            shares = []
            sys.setswitchinterval(1000)
            start.set()
            context.accumulate(2**16, progress=lambda share: shares.append(share) or bool(ran) or len(shares) > 1000)
            sys.setswitchinterval(interval)
            self.assertTrue(ran)
        thread.join()

    def test_one_call_at_a_time(self):
        with ready(pt.Context()) as context:
            def call(_):
                for function, words in ((context.stats, "another call on this context is under way"),
                                        (context.close, "the context cannot be closed while a call on it is under way")):
                    with self.assertRaisesRegex(pt.InvalidStateError, words):
                        function()
                return True

            self.assertIs(context.accumulate(1000, progress=call), pt.Result.CANCELLED)
            context.stats()


class Libraries(unittest.TestCase):
    def test_where_it_is_looked_for(self):
        with mock.patch.dict(os.environ, PT_LIBRARY="/some/where"):
            self.assertEqual(_library.library_path(), "/some/where")
        with mock.patch.dict(os.environ, PT_LIBRARY=""):
            beside = pathlib.Path(pt.__file__).with_name(_library.SONAME)
            for exists, found in (False, _library.SONAME), (True, str(beside)):
                with mock.patch.object(pathlib.Path, "exists", return_value=exists):
                    self.assertEqual(_library.library_path(), found)

    def test_what_is_no_libpt_is_refused(self):
        for path in "/no/such/library", "libc.so.6":
            with self.assertRaisesRegex(ImportError, f"{path} cannot be loaded as libpt"):
                _library.load_library(path)
        with mock.patch.object(_library, "version_text", return_value="0.2.9"):
            with self.assertRaisesRegex(ImportError, f"is libpt 0.2.9; this package is for {_library.SONAME}"):
                _library.load_library(_library.library_path())

    def test_version_and_devices(self):
        self.assertRegex(pt.version(), r"^0\.4\.\d+$")
        self.assertEqual(pt.__version__, pt.version())
        found = pt.devices()
        suitable = [device for device in found if device.suitable]
        self.assertTrue(suitable)
        for device in suitable:
            self.assertGreater(device.memory_bytes, 0)
            self.assertEqual(device.reason, "")
        with pt.Context(str(found.index(suitable[0]))) as context:
            self.assertEqual(context.device, suitable[0])
            self.assertEqual(context.stats().device_count, 1)
        with pt.Context(suitable[0].uuid.hex, scene_kernels=False) as context:
            self.assertEqual(context.device.uuid, suitable[0].uuid)


class Interrupts(unittest.TestCase):
    def setUp(self):
        signal.signal(signal.SIGINT, signal.default_int_handler)  # Shells let background jobs ignore SIGINT.
        signal.signal(signal.SIGALRM, mock.Mock(side_effect=TimeoutError))
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
        self.assertIs(self.context.set_scene(MANY_SPHERES, lambda _: True), pt.Result.CANCELLED)
        self.assertEqual(self.context.film(), film)
        told = []
        self.assertIs(self.context.accumulate(ENDLESS, progress=lambda fraction: told.append(fraction) or len(told) > 3),
                      pt.Result.CANCELLED)
        self.assertEqual(len(told), 4)
        for value in 1, "stop":
            self.assertIs(self.context.set_scene(MANY_SPHERES, lambda _: value), pt.Result.OK)

    def test_what_progress_raises(self):
        fail, interrupt = mock.Mock(side_effect=LookupError("where it is")), lambda _: signal.raise_signal(signal.SIGINT)
        for error, words, progress in (LookupError, "where it is", fail), (KeyboardInterrupt, "", interrupt):
            self.context.accumulate(4)
            film = self.context.film()
            with self.assertRaisesRegex(error, words):
                self.context.set_scene(MANY_SPHERES, progress)
            self.assertEqual(self.context.film(), film)
            with self.assertRaisesRegex(error, words):
                self.context.accumulate(ENDLESS, progress=progress)
            self.check_usable()
        with self.assertRaises(LookupError):
            pt.Context(log=fail)

    def test_a_signal_while_samples_are_taken(self):
        """The signal's exception must also be raised without a progress function."""
        for _ in range(3):
            with self.assertRaises(TimeoutError):
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
        self.assertEqual(set(told), {LookupError})
        self.context.accumulate(1, progress=lambda _: setattr(sys, "unraisablehook", told.append))
        self.assertEqual(sys.unraisablehook, told.append, "a hook that is set meanwhile stays")
        sys.unraisablehook = hook
