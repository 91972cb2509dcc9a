"""Many short runs of a program that is loaded once (loaded_once.cc).

    program = Program("build/source/stockwork", "build/tests/loaded_once/libloaded_once.so", scratch)
    status, said, complained = program.run([deck, "--check"])

Each run is a process of its own, with the exit status, output and complaints that it would have if it were
started by itself."""
import os
import subprocess


class Program:
    def __init__(self, program, library, scratch):
        self.scratch = os.path.abspath(scratch)
        os.makedirs(self.scratch, exist_ok=True)
        environment = dict(os.environ, LD_PRELOAD=os.path.abspath(library), OMP_NUM_THREADS="1",
                           OPENBLAS_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
        self.server = subprocess.Popen([os.path.abspath(program)], stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, env=environment)

    def run(self, arguments, directory=None):
        """(exit status, negative for a signal; standard output; standard error)"""
        names = [os.path.join(self.scratch, name) for name in ("said", "complained")]
        words = [str(len(arguments)), *arguments, directory or self.scratch, *names]
        self.server.stdin.write(b"".join(os.fsencode(word) + b"\0" for word in words))
        self.server.stdin.flush()
        answer = self.server.stdout.readline()
        if not answer:
            raise RuntimeError(f"{self.server.args[0]} has ended")
        texts = []
        for name in names:
            with open(name, encoding="utf-8", errors="replace") as file:
                texts.append(file.read())
        return os.waitstatus_to_exitcode(int(answer)), *texts

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.server.stdin.close()
        self.server.wait()
