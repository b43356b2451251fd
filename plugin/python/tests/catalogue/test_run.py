# SPDX-License-Identifier: GPL-3.0-or-later
"""garmentfit catalogue with a program that does nothing quickly: rows, limits, resuming, faults."""
import csv
import fcntl
import json
import os
import pty
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import termios
import threading
import time
from pathlib import Path

import pytest

for needed in ("distributed", "psutil", "pyarrow", "tqdm"):
    pytest.importorskip(needed)
import dask  # noqa: E402
import distributed  # noqa: E402
import pyarrow.parquet  # noqa: E402
from garmentfit.catalogue import command, scheduling  # noqa: E402
from garmentfit.catalogue.store import Store  # noqa: E402

import faults  # noqa: E402

FAKE = f"{sys.executable} {Path(__file__).parent / 'fake_program.py'}"
CATALOGUE = [sys.executable, "-m", "garmentfit", "catalogue"]


class Trial:
    """A plan of bodies x garments, each garment file with a word for the program."""

    def __init__(self, folder, bodies, words, limits="", seconds=0):
        self.folder, self.output, self.counts = folder, folder / "out", folder / "counts"
        self.environment = dict(os.environ, FAKE_COUNTS=str(self.counts), FAKE_SECONDS=str(seconds))
        for index in range(bodies):
            (folder / f"body{index}.ply").write_text(f"body {index}")
        for index, word in enumerate(words):
            (folder / f"garment{index}.ply").write_text(f"{word} {index}")
        (folder / "plan.toml").write_text('bodies = ["body*.ply"]\ngarment_files = ["garment*.ply"]\n' + limits)
        self.command = [*CATALOGUE, str(folder / "plan.toml"), "-o", str(self.output), "--program", FAKE,
                        "--workers", "2", "--quiet"]

    def run(self, *words, largest_file=None):
        """largest_file: bytes; a write beyond it fails, as on a full disk."""
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))
        return subprocess.run([*self.command, *words], env=self.environment, capture_output=True, text=True,
                              timeout=300, preexec_fn=limit if largest_file else None)

    def start(self, cluster=None):
        return faults.Run(self.command, self.output, cluster, environment=self.environment)

    def rows(self):
        with open(self.output / "results.csv", newline="") as file:
            return list(csv.DictReader(file))

    def finished(self):
        return faults.finished(self.output)


def test_every_way_to_end_costs_one_row(tmp_path):
    words = ["ok", "crash", "hang", "memory", "small", "wrong"]
    trial = Trial(tmp_path, 1, words, "[limits]\nseconds = 4\nmemory_mb = 200\n")
    done = trial.run()
    assert done.returncode == 0, done.stderr
    reasons = {row["garment"]: row["reason"] for row in trial.rows()}
    wanted = ["done", "crashed", "time_limit", "memory_limit", "too_small", "no_faces"]
    assert reasons == {f"garment{index}": reason for index, reason in enumerate(wanted)}
    for row in trial.rows():
        assert "dress" in (trial.output / row["folder"] / "log.txt").read_text() and row["garment_files"]
    table = pyarrow.parquet.read_table(trial.output / "results.parquet").to_pylist()
    assert [row["reason"] for row in table] == [row["reason"] for row in trial.rows()]
    assert table[0]["ease_waist"] == 0.04 and table[0]["type_probability"] == 0.9


def test_a_plan_may_give_each_pair_more_threads(tmp_path):
    trial = Trial(tmp_path, 1, ["ok"], "[limits]\nthreads = 2\n")
    assert trial.run().returncode == 0
    assert "--threads 2" in (trial.output / trial.rows()[0]["folder"] / "log.txt").read_text()
    (tmp_path / "plan.toml").write_text((tmp_path / "plan.toml").read_text().replace("threads = 2", "threads = 1"))
    before = trial.finished()
    assert trial.run().returncode == 0 and trial.finished() == before  # the result is the same


def test_a_second_run_does_nothing_again_and_a_larger_plan_only_the_rest(tmp_path):
    trial = Trial(tmp_path, 2, ["ok"] * 5)
    assert trial.run().returncode == 0
    before = trial.finished()
    (tmp_path / "garment9.ply").write_text("ok 9")
    done = trial.run()
    assert done.returncode == 0 and "12 of 12 pairs finished" in done.stdout
    after = trial.finished()
    assert len(before) == 2 + 10 and len(after) == 2 + 12 and all(after[key] == before[key] for key in before)
    assert len(trial.counts.read_text().splitlines()) == 2 + 12  # rigs, once for each body, and pairs


def test_two_runs_in_one_folder_and_an_unwritable_one_end_clearly(tmp_path):
    trial = Trial(tmp_path, 1, ["ok"] * 40, seconds=1)
    first = trial.start()
    try:
        wait_for(lambda: (trial.output / "plan.jsonl").exists())
        second = trial.run()
        assert second.returncode == 2 and "another run" in second.stderr and second.stderr.count("\n") == 1
    finally:
        first.stop()
    (tmp_path / "file").write_text("")
    bad = trial.run("-o", str(tmp_path / "file" / "out"))
    assert bad.returncode == 2 and "cannot be written" in bad.stderr


def test_a_disk_that_takes_no_more_ends_with_4_and_one_line(tmp_path):
    trial = Trial(tmp_path, 1, ["ok"] * 8)
    full = trial.run(largest_file=1_500)  # the plan is larger
    assert full.returncode == 4 and "cannot be written" in full.stderr and full.stderr.count("\n") == 1
    assert trial.run().returncode == 0
    full = trial.run(largest_file=200_000)  # the page is larger
    assert full.returncode == 4 and "cannot be written" in full.stderr and full.stderr.count("\n") == 1
    (trial.output / "lock").unlink()
    (trial.output / "lock").mkdir()
    wrong = trial.run()
    assert wrong.returncode == 2 and "cannot be written" in wrong.stderr and wrong.stderr.count("\n") == 1


def test_an_unreadable_file_costs_its_own_rows(tmp_path):
    trial = Trial(tmp_path, 1, ["ok"] * 2)
    for name in ("body9", "garment9"):
        (tmp_path / f"{name}.ply").symlink_to(tmp_path / f"gone_{name}.ply")
    done = trial.run()
    assert done.returncode == 0, done.stderr
    rows = {(row["body"], row["garment"]): row for row in trial.rows()}
    assert len(rows) == 6 and sum(row["reason"] == "done" for row in rows.values()) == 2
    bad = rows["body0", "gone_garment9"]
    assert (bad["reason"], bad["exit"]) == ("unreadable_file", "2") and "gone_garment9.ply: No such" in bad["message"]
    assert "gone_garment9.ply" in (trial.output / bad["folder"] / "log.txt").read_text()
    (tmp_path / "gone_garment9.ply").write_text("ok 9")
    assert trial.run().returncode == 0
    rows = {(row["body"], row["garment"]): row["reason"] for row in trial.rows()}
    assert rows["body0", "gone_garment9"] == "done" and rows["gone_body9", "gone_garment9"] == "unreadable_file"


def test_a_file_that_the_command_may_not_look_at_costs_its_own_rows(tmp_path):
    """A link to itself stands for a folder without permission, which the system's administrator would have."""
    trial = Trial(tmp_path, 2, ["ok"])
    for name in ("closed.ply", "body9.ply"):
        (tmp_path / name).symlink_to(name)
    (tmp_path / "plan.toml").write_text('bodies = ["body*.ply"]\ngarment_files = ["garment0.ply"]\n'
                                        '[[garments]]\nlayers = ["closed.ply"]\n')
    done = trial.run()
    assert done.returncode == 0, done.stderr
    reasons = [(row["garment"], row["body"], row["reason"]) for row in trial.rows()]
    assert [body for _, body, reason in reasons if reason == "done"] == ["body0", "body1"]
    assert sum(reason == "unreadable_file" for _, _, reason in reasons) == 4 == len(reasons) - 2
    assert any("symbolic links; the command reads all files itself" in row["message"] for row in trial.rows())


def test_a_limit_of_file_size_is_named(tmp_path):
    trial = Trial(tmp_path, 1, ["ok", "large"])
    assert trial.run(largest_file=4_000_000).returncode == 0
    row = {row["garment"]: row for row in trial.rows()}["garment1"]
    assert row["reason"] == "file_limit" and "4 MB" in row["message"]
    again = trial.run("--retry", largest_file=4_000_000)
    assert again.returncode == 0 and len(trial.counts.read_text().splitlines()) == 2  # a rig and the good pair


def test_ctrl_c_leaves_a_folder_that_resumes(tmp_path):
    trial = Trial(tmp_path, 1, ["ok"] * 30, seconds=3)  # so long that a slow machine does not miss the end of the run
    run = trial.start()
    wait_for(lambda: len(trial.finished()) > 3)
    run.process.send_signal(signal.SIGINT)
    assert run.process.wait(60) == 130
    before = trial.finished()
    trial.environment["FAKE_SECONDS"] = "0"
    assert 3 < len(before) < 1 + 30
    assert trial.run().returncode == 0
    after = trial.finished()
    assert len(after) == 1 + 30 and all(after[key] == before[key] for key in before)


def test_a_terminal_sees_a_bar_with_rate_and_time_left_and_a_quiet_run_none(tmp_path):
    trial = Trial(tmp_path, 1, ["ok"] * 12, seconds=0.3)
    shown = seen_in_a_terminal([word for word in trial.command if word != "--quiet"], trial.environment)
    assert re.search(r"dress:\s+\d+%.* \d+/12 \[\d+:\d+<\d+:\d+, +\d.*(pair/s|s/pair)\]", shown), shown
    (tmp_path / "garment99.ply").write_text("ok 99")
    assert "dress" not in seen_in_a_terminal(trial.command, trial.environment)


def seen_in_a_terminal(words, environment):
    """What a command writes to its terminal."""
    ours, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("4H", 24, 100, 0, 0))  # rows and columns; a new one has none
    with subprocess.Popen(words, env=environment, stdin=its, stdout=its, stderr=its) as process:
        os.close(its)
        text = b""
        try:
            while block := os.read(ours, 4096):
                text += block
        except OSError:  # all ends are closed
            pass
    os.close(ours)
    assert process.returncode == 0, text
    return text.decode()


def test_ctrl_c_is_no_lost_scheduler_where_closing_fails_after_it(tmp_path, monkeypatch, capsys):
    def stopped(*_):
        try:
            raise KeyboardInterrupt
        finally:
            raise TimeoutError("the workers did not close in time")
    trial = Trial(tmp_path, 1, ["ok"])
    monkeypatch.setattr(scheduling, "run_jobs", stopped)
    assert command.main(trial.command[len(CATALOGUE):]) == 130
    assert "the same command goes on from here" in capsys.readouterr().err


def test_workers_that_do_not_answer_in_time_end_with_4_and_a_line(tmp_path, monkeypatch, capsys):
    def late(*_):
        raise TimeoutError  # as Dask does
    trial = Trial(tmp_path, 1, ["ok"])
    monkeypatch.setattr(scheduling, "run_jobs", late)
    assert command.main(trial.command[len(CATALOGUE):]) == 4
    assert "did not answer in time; run again" in capsys.readouterr().err


@pytest.mark.parametrize("seed", [1, 2])
def test_killed_at_random_it_ends_with_the_same_results(tmp_path, seed):
    """kill -9 of client, worker or job at random moments, fixed seeds; then one run to the end."""
    chance = random.Random(seed)
    words = ["ok"] * 35 + ["small"] * 3 + ["wrong"] * 2
    (tmp_path / "calm").mkdir()
    calm = Trial(tmp_path / "calm", 2, words)
    assert calm.run().returncode == 0
    shutil.copytree(tmp_path / "calm", tmp_path / "storm", ignore=shutil.ignore_patterns("out", "counts"))
    storm = Trial(tmp_path / "storm", 2, words, seconds=0.2)
    seen = {}
    for victim in ("job", "worker", "client"):
        run = storm.start()
        wait_for(lambda: len(storm.finished()) > len(seen))
        time.sleep(chance.uniform(0, 2))
        wait_for(lambda: run.kill_one(victim, chance))
        time.sleep(chance.uniform(0.2, 1))
        run.stop()
        now = storm.finished()
        assert all(now[key] == seen[key] for key in seen)
        seen = now
    assert storm.run().returncode == 0
    now = storm.finished()
    assert all(now[key] == seen[key] for key in seen)
    kept = ["body", "garment", "exit", "reason", "verdict", "type", "ease_waist", "strain_max"]
    assert [[row[name] for name in kept] for row in storm.rows()] == [[row[name] for name in kept]
                                                                      for row in calm.rows()]
    assert not any((storm.output / "work").iterdir())


@pytest.mark.parametrize("where", [[], ["--cluster", "2"]])
def test_the_harness_runs_any_plan_to_its_end_and_counts(tmp_path, where):
    trial = Trial(tmp_path, 2, ["ok"] * 15 + ["small", "crash"], seconds=0.3)
    words = ["--seed", "3", "--kills", "3", "--seconds", "2", "4", *where, "--", *trial.command]
    done = subprocess.run([sys.executable, faults.__file__, *words], env=trial.environment, capture_output=True,
                          text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "for 36 rigs and pairs, none for a finished one" in done.stdout
    assert "34 rows for 34 pairs: 30 done, 2 too_small, 2 crashed" in done.stdout


def test_the_harness_notices_what_is_done_again(tmp_path):
    trial = Trial(tmp_path, 1, ["ok"])
    starts = faults.Starts(tmp_path, FAKE.split())
    assert trial.run("--program", starts.program).returncode == 0 and len(starts.read()) == 2
    before = trial.finished()
    assert faults._wrong(before, trial.finished(), starts) == ""
    shutil.copytree(trial.output / "jobs", tmp_path / "kept")
    shutil.rmtree(trial.output / "jobs")
    assert trial.run("--program", starts.program).returncode == 0 and len(starts.read()) == 3
    assert "changed afterwards" in faults._wrong(before, trial.finished(), starts)
    shutil.rmtree(trial.output / "jobs")
    (tmp_path / "kept").rename(trial.output / "jobs")
    assert "started again" in faults._wrong(before, trial.finished(), starts)


def test_a_cluster_of_others_does_the_same_though_its_scheduler_and_a_worker_are_killed(tmp_path):
    trial, chance = Trial(tmp_path, 1, ["ok"] * 30, seconds=0.3), random.Random(1)
    with faults.Cluster(2, tmp_path, trial.environment) as cluster:
        run = trial.start(cluster)
        for victim, least in (("worker", 3), ("scheduler", 8)):
            wait_for(lambda: len(trial.finished()) >= least)
            assert run.kill_one(victim, chance)
        wait_for(lambda: cluster.mend() or run.process.poll() is not None)  # workers end some time after the scheduler
        assert run.process.returncode == 0
    rows = trial.rows()
    assert len(rows) == 30 and all(row["reason"] == "done" for row in rows)


def test_a_scheduler_that_stays_away_ends_with_4_and_the_folder_resumes(tmp_path, monkeypatch, capfd):
    trial = Trial(tmp_path, 1, ["ok"] * 20, seconds=0.3)
    with faults.Cluster(2, tmp_path, trial.environment) as cluster:
        def kill_it():
            wait_for(lambda: len(trial.finished()) >= 3)
            monkeypatch.setattr(scheduling, "_PATIENCE_SECONDS", 2)
            cluster.scheduler.kill()

        killer = threading.Thread(target=kill_it)
        killer.start()
        assert command.main([*trial.command[len(CATALOGUE):], "--scheduler", cluster.address]) == 4
        killer.join()
    assert "run again" in capfd.readouterr().err
    seen = trial.finished()
    assert trial.run().returncode == 0
    now = trial.finished()
    assert len(now) == 21 and all(now[key] == seen[key] for key in seen)


def test_a_worker_that_dask_gave_up_is_started_again(tmp_path, monkeypatch):
    """Dask does so where a worker that was killed needs more than 15 s to start again, as on a busy machine."""
    def kill_its_worker_once(name):
        if not os.path.exists(name):
            open(name, "w").close()
            os.kill(os.getpid(), signal.SIGKILL)

    monkeypatch.setattr(scheduling, "_PATIENCE_SECONDS", 30)
    with dask.config.set({"distributed.deploy.lost-worker-timeout": "1ms"}):
        assert scheduling.run_jobs(kill_its_worker_once, [(str(tmp_path / "killed"),)], workers=1) == 1


def test_a_long_plan_is_handed_out_in_parts_and_workers_are_counted_once_in_a_while(monkeypatch):
    """Else the scheduler's memory would grow with the plan; and of 1,000 workers an answer has a megabyte."""
    asked, ask = [], distributed.Client.scheduler_info
    monkeypatch.setattr(distributed.Client, "scheduler_info", lambda *_, **more: asked.append(1) or ask(*_, **more))
    read, waiting, start = [], [], time.monotonic()

    def jobs():
        for _ in range(1000):
            read.append(1)
            yield (0,)

    def arrived():
        waiting.append(len(read) - len(waiting) - 1)

    assert scheduling.run_jobs(time.sleep, jobs(), workers=1, arrived=arrived) == 1000
    assert len(waiting) == 1000 and max(waiting) < 64
    assert len(asked) <= 2 + time.monotonic() - start


def wait_for(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_status_counts_the_ends_of_a_folder_at_any_time(tmp_path):
    def status():
        return subprocess.run([*CATALOGUE, "status", str(trial.output)], capture_output=True, text=True, timeout=60)
    trial = Trial(tmp_path, 1, ["ok", "ok", "small", "wrong"])
    none = status()
    assert none.returncode == 2 and "no catalogue" in none.stderr and none.stderr.count("\n") == 1
    assert trial.run().returncode == 0
    assert status().stdout.split("\n") == ["4 of 4 pairs finished", "       2  done", "       1  too_small",
                                           "       1  no_faces", ""]
    shutil.rmtree(next(iter(trial.output.glob("jobs/*/*/done.json"))).parent)
    with Store(trial.output).lock():  # while a run is at work
        now = status()
    assert now.returncode == 0 and "3 of 4 pairs finished" in now.stdout and "1  waiting" in now.stdout


def test_an_outfit_of_layers_has_the_ease_of_each_garment(tmp_path):
    trial = Trial(tmp_path, 1, ["ok", "ok"])
    (tmp_path / "plan.toml").write_text('bodies = ["body0.ply"]\ngarment_files = ["garment0.ply"]\n'
                                        '[[garments]]\nlayers = ["garment0.ply", "garment1.ply"]\n')
    assert trial.run("--no-pictures").returncode == 0
    single, outfit = pyarrow.parquet.read_table(trial.output / "results.parquet").to_pylist()
    assert (outfit["layer1_ease_waist"], outfit["layer2_ease_waist"], outfit["ease_waist"]) == (0.04, 0.05, 0.05)
    assert outfit["layer1_verdict"] == "fits" and outfit["layer2_strain_max"] == 0.1
    assert single["ease_waist"] == 0.04 and single["layer1_ease_waist"] is None
    assert trial.rows()[1]["layer2_ease_waist"] == "0.05"


def test_a_simulated_cluster_says_how_far_it_is_and_does_all_jobs():
    script = Path(__file__).parent / "measure_scheduling.py"
    done = subprocess.run([sys.executable, script, "--jobs", "300", "--no-processes", "--simulated", "120"],
                          capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "50 of 120 workers started\n" in done.stdout and "120 workers after" in done.stdout
    assert "300 jobs" in done.stdout.splitlines()[-1]
