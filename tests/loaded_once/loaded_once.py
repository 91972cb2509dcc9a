#!/usr/bin/python3
"""Short runs of a program that is loaded once (loaded_once.cc).

    loaded_once.py LIBRARY PROGRAM ARGUMENT...      as if PROGRAM were started by itself

    program = Program("build/source/stockwork", "build/tests/loaded_once/libloaded_once.so")
    process = program.start([deck], out, err, directory, environment)      as subprocess.Popen
    status, said, complained = program.run([deck, "--check"], directory)   to its end

Each run is a process of its own, with the exit status, output and complaints that it would have if it were
started by itself. The first who asks starts the server, for all who come after; it ends when nobody has asked
for a minute, or when the program or a library of it has been built anew."""
import hashlib
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

# Else a copy of the process would lack its threads.
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "DEAL_II_NUM_THREADS")}


class Process:
    """What `subprocess.Popen` is to its caller: pid, returncode, poll, wait, kill."""

    def __init__(self, connection, pid):
        self.connection, self.pid, self.returncode = connection, pid, None

    def wait(self, timeout=None):
        if self.returncode is None:
            self.connection.settimeout(timeout)
            try:
                status = self.connection.recv(64)
            except (socket.timeout, BlockingIOError):
                raise subprocess.TimeoutExpired("loaded once", timeout) from None
            self.connection.close()
            self.returncode = os.waitstatus_to_exitcode(int(status)) if status else 127
        return self.returncode

    def poll(self):
        try:
            return self.wait(0)
        except subprocess.TimeoutExpired:
            return None

    def kill(self):
        if self.poll() is None:
            os.kill(self.pid, signal.SIGKILL)


class Program:
    def __init__(self, program, library):
        self.program, self.library = os.path.realpath(program), os.path.realpath(library)
        # Two trees of which one is mounted in the other's place are two programs.
        place = f"{self.program} {os.stat(self.program).st_ino} {os.stat('/proc/self/ns/mnt').st_ino} {self.library}"
        self.name = f"loaded-once-{os.getuid()}-" + hashlib.sha256(place.encode()).hexdigest()[:32]

    def start(self, arguments, stdout, stderr, directory, environment=None):
        words = [str(len(arguments)), *arguments, os.path.abspath(directory)]
        words += [f"{name}={value}" for name, value in {**(environment or os.environ), **ONE_THREAD}.items()]
        request = b"".join(os.fsencode(word) + b"\0" for word in words)
        for _ in range(20):
            connection = self._connection()
            try:
                sent = socket.send_fds(connection, [request], [stdout.fileno(), stderr.fileno()])
                connection.sendall(request[sent:])
                connection.shutdown(socket.SHUT_WR)
                pid = self._line(connection)
            except (BrokenPipeError, ConnectionResetError):
                pid = b""
            if pid:
                return Process(connection, int(pid))
            connection.close()  # it was about to end
        raise RuntimeError(f"{self.program} cannot be kept loaded")

    def run(self, arguments, directory):
        """(exit status, negative for a signal; standard output; standard error)"""
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            status = self.start(arguments, out, err, directory).wait()
            texts = []
            for file in (out, err):
                file.seek(0)
                texts.append(file.read().decode("utf-8", "replace"))
        return status, *texts

    def _connection(self):
        """To the server, which is started where there is none."""
        server = None
        until = time.monotonic() + 60
        while time.monotonic() < until:
            connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
            try:
                connection.connect("\0" + self.name)
                return connection
            except ConnectionRefusedError:
                connection.close()
            if server is None or server.poll() is not None:
                environment = {**os.environ, **ONE_THREAD, "LD_PRELOAD": self.library, "LOADED_ONCE": self.name}
                server = subprocess.Popen([self.program], env=environment, cwd="/", start_new_session=True,
                                          stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(0.02)
        raise RuntimeError(f"{self.program} does not start with {self.library}")

    @staticmethod
    def _line(connection):
        """One at a time, for a short run's status may already be behind it."""
        line = b""
        while not line.endswith(b"\n"):
            byte = connection.recv(1)
            if not byte:
                return b""
            line += byte
        return line


def main():
    library, program, *arguments = sys.argv[1:]
    sys.stdout.flush()
    process = Program(program, library).start(arguments, sys.stdout, sys.stderr, os.getcwd())
    status = process.wait()
    sys.exit(status if status >= 0 else 128 - status)


if __name__ == "__main__":
    main()
