# SPDX-License-Identifier: LGPL-2.1-or-later
"""hpvi as a server that forks a process for each run, by the library of server.cc: what stands before main() is done once, and a run
costs a tenth of its start."""
import os
import select
import signal
import subprocess


class Server:
    def __init__(self, program, library, environment, directory):
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=directory, bufsize=0,  # select() knows no buffer
                                        env={**environment, "OMP_NUM_THREADS": "1", "LD_PRELOAD": str(library)})

    def stop(self):
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()

    def run(self, arguments, home, out, errors, megabytes, cpu_seconds, wall_seconds):
        """Status as of waitpid, kilobytes, seconds, was it ended?"""
        request = [home, out, errors, str(megabytes), str(cpu_seconds), "hpvi", *arguments]
        self.process.stdin.write(b"%d\0" % len(request) + b"".join(os.fsencode(part) + b"\0" for part in request))
        self.process.stdin.flush()
        child = int(self.process.stdout.readline().split()[1])
        ended = False
        while not select.select([self.process.stdout], [], [], wall_seconds)[0]:
            ended = True
            os.kill(child, signal.SIGKILL)
        _, status, kilobytes, seconds = self.process.stdout.readline().split()
        return int(status), int(kilobytes), float(seconds), ended
