"""Runs: progress, notes, stops, exceptions, threads, and that nothing is kept."""
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import quorum
from quorum import ErrorKind

DRAFT = {"device": "cpu", "neighbors": 2, "quality": "draft", "min_component": 0, "min_confidence": 0}


def test_progress_and_notes_are_told(ball, tmp_path):
    seen, notes = [], []
    quorum.reconstruct(ball.scene(), tmp_path, on_progress=seen.append, on_note=notes.append, **DRAFT)
    assert {progress.stage for progress in seen} >= {"computing depth maps"}
    assert [progress.run_percent for progress in seen] == sorted(progress.run_percent for progress in seen)
    assert seen[-1].run_percent > 99
    quorum.reconstruct(ball.scene(), tmp_path, on_note=notes.append, **DRAFT)
    assert any("kept" in note for note in notes)


def test_an_event_stops_from_another_thread_and_the_run_goes_on_from_there(ball, tmp_path):
    stop = threading.Event()
    begun = threading.Event()

    def stop_it():
        begun.wait()
        stop.set()

    helper = threading.Thread(target=stop_it)
    helper.start()
    with pytest.raises(quorum.Error) as caught:
        quorum.reconstruct(
            ball.scene(), tmp_path, on_progress=lambda _: (begun.set(), helper.join()), should_stop=stop.is_set, **DRAFT
        )
    assert caught.value.kind == ErrorKind.STOPPED == 143
    with pytest.raises(quorum.Error):
        quorum.reconstruct(ball.scene(), tmp_path, should_stop=lambda: True, **DRAFT)
    whole = quorum.reconstruct(ball.scene(), tmp_path, **DRAFT)
    assert len(whole.mesh().faces) > 1000


def test_what_callbacks_raise_comes_out(ball):
    class Mine(Exception):
        pass

    def throws(*_):
        raise Mine("so")

    for name in ("on_progress", "should_stop"):
        with pytest.raises(Mine, match="so"):
            quorum.reconstruct(ball.scene(), **{name: throws}, **DRAFT)
    with pytest.raises(TypeError):
        quorum.reconstruct(ball.scene(), on_progress=5, **DRAFT)


def test_the_progress_callback_can_stop(ball):
    stop = threading.Event()
    steps = []

    def tell(progress):
        steps.append(progress.done)
        if progress.done == 2:
            stop.set()

    with pytest.raises(quorum.Error) as caught:
        quorum.reconstruct(ball.scene(), on_progress=tell, should_stop=stop.is_set, **DRAFT)
    assert caught.value.kind == ErrorKind.STOPPED
    assert max(steps) < 6


def test_an_interrupt_is_a_keyboard_interrupt(ball):
    def interrupt(progress):
        if progress.done == 1:
            os.kill(os.getpid(), signal.SIGINT)

    # Python's own handler asks for the exception while the run is in C++.
    with pytest.raises(KeyboardInterrupt):
        quorum.reconstruct(ball.scene(), on_progress=interrupt, **DRAFT)


def test_ctrl_c_ends_a_script(tmp_path):
    """A signal from outside, while no Python runs."""
    script = tmp_path / "script.py"
    script.write_text(
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "import conftest, quorum\n"
        "ball = conftest.Ball()\n"
        "print('begun', flush=True)\n"
        "while True: quorum.reconstruct(ball.scene(), device='cpu', neighbors=4)\n"
    )
    child = subprocess.Popen(
        [sys.executable, script, os.path.dirname(__file__)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    child.stdout.readline()
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    _, said = child.communicate(timeout=60)
    assert said.strip().endswith("KeyboardInterrupt")
    assert child.returncode == -signal.SIGINT


def test_threads_run_at_once_and_python_goes_on(ball):
    meshes = [None, None]

    def run(place):
        meshes[place] = quorum.reconstruct(ball.scene(), **DRAFT).mesh()

    threads = [threading.Thread(target=run, args=(place,)) for place in range(2)]
    for thread in threads:
        thread.start()
    turns = 0
    while any(thread.is_alive() for thread in threads):
        turns += 1
        time.sleep(0.001)
    assert turns > 20  # the GIL was free
    assert np.array_equal(meshes[0].vertices, meshes[1].vertices)
    assert np.array_equal(meshes[0].faces, meshes[1].faces)


def resident():
    """What the process holds, MiB."""
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def grown(call, count=1000):
    """How much more is held after so many calls, MiB. The first hundred fill what is kept for good."""
    for _ in range(100):
        call()
    before = resident()
    for _ in range(count):
        call()
    return resident() - before


def test_a_thousand_calls_keep_nothing(flat, ball, monkeypatch):
    """A map takes 0.44 MiB and a mesh 0.07, so that one kept in 25 calls would show."""
    results = quorum.reconstruct(ball.scene(), voxel_size=0.06, **DRAFT)
    assert results.mesh().vertices.nbytes > 10_000

    def refuse():
        with pytest.raises(quorum.Error):
            quorum.Scene.from_arrays(**{**flat, "t": np.full((3, 3), np.nan)})

    if os.path.isdir("/dev/shm"):
        monkeypatch.setenv("TMPDIR", "/dev/shm")  # photographs of arrays are synced to the disk elsewhere
    assert grown(lambda: results.depth_map(2).depth.sum()) < 3
    assert grown(lambda: results.mesh().vertices.sum()) < 3
    assert grown(lambda: quorum.Scene.from_arrays(**flat).views[0].K) < 3
    assert grown(refuse) < 3
    assert grown(lambda: quorum.options()) < 3
