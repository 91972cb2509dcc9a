"""A bar on a terminal, a line for each run elsewhere."""
import shutil
import sys
import threading
import time

from study.estimate import in_time

WIDTH = 24


class Progress:
    def __init__(self, expected, cores, stream=sys.stderr):
        """expected: {name: seconds} of the runs to come, each at least a little."""
        self.expected, self.cores, self.stream = dict(expected), cores, stream
        self.total = len(expected)
        self.weight = sum(expected.values())
        self.done, self.failed, self.running = 0, 0, []
        self.lock = threading.Lock()
        self.begin = time.monotonic()

    def started(self, name):
        with self.lock:
            self.running.append(name)
            self.draw()

    def ended(self, name, status, seconds, reason):
        with self.lock:
            self.running.remove(name)
            self.done += 1
            self.failed += status == "failed"
            del self.expected[name]
            if not self.stream.isatty() or status == "failed":
                self.clear()
                print(f"[{self.done}/{self.total}] {name}: {status}" + (f" after {in_time(seconds)}" if seconds else "")
                      + (f". {reason}" if reason else ""), file=self.stream, flush=True)
            self.draw()

    def left(self):
        """Seconds: what was expected of the rest, times how wrong that was of what has ended."""
        ended = self.weight - sum(self.expected.values())
        passed = time.monotonic() - self.begin
        pace = passed / ended if ended > 0 and passed > 5. else 1. / self.cores
        return pace * sum(self.expected.values())

    def draw(self):
        if not self.stream.isatty():
            return
        share = 1. - sum(self.expected.values()) / self.weight if self.weight else 1.
        bar = "#" * round(WIDTH * share)
        text = f"[{bar:.<{WIDTH}}] {self.done}/{self.total}" + (f", {self.failed} failed" if self.failed else "")
        text += f", {in_time(self.left())} left: {', '.join(self.running)}"
        self.clear()
        if self.expected:
            print(text[:shutil.get_terminal_size().columns - 1], end="", file=self.stream, flush=True)

    def clear(self):
        if self.stream.isatty():
            print("\r\033[K", end="", file=self.stream, flush=True)
