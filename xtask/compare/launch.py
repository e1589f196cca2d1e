"""Runs a command and says what it cost: `launch.py REPORT.json SECONDS OUT.txt ERR.txt -- COMMAND…`.

The report has `status` (exit code; negative: the signal), `timed_out`, `wall_seconds`, `cpu_seconds` (user and system)
and `peak_memory_bytes` (`ru_maxrss` of the child; never less than the 10 MB of this interpreter, which the child is
born with: what a process says of itself goes before). Standard library only.
"""

import json
import os
import signal
import subprocess
import sys
import time


def main():
    report, limit, out, err, _, *command = sys.argv[1:]
    with open(out, "wb") as stdout, open(err, "wb") as stderr:
        start = time.perf_counter()
        child = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=stdout, stderr=stderr, start_new_session=True
        )
        timed_out = []

        def stop(*_):
            timed_out.append(True)
            os.killpg(child.pid, signal.SIGKILL)

        signal.signal(signal.SIGALRM, stop)
        signal.setitimer(signal.ITIMER_REAL, float(limit))
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.perf_counter() - start
        signal.setitimer(signal.ITIMER_REAL, 0)
    cost = {
        "status": os.waitstatus_to_exitcode(status),
        "timed_out": bool(timed_out),
        "wall_seconds": wall,
        "cpu_seconds": usage.ru_utime + usage.ru_stime,
        # Kilobytes everywhere but on macOS.
        "peak_memory_bytes": usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024),
    }
    with open(report, "w", encoding="utf-8") as file:
        json.dump(cost, file)


main()
