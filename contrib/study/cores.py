"""Cores that are given out, so that each run has its own, and how much of them others have used."""
import os
import threading


class Cores:
    """A run holds as many cores as it has ranks, and no other run of the study uses them meanwhile."""

    def __init__(self, number):
        self.all = sorted(os.sched_getaffinity(0))[:number]
        self.free = list(self.all)
        self.changed = threading.Condition()

    def take(self, number):
        with self.changed:
            self.changed.wait_for(lambda: len(self.free) >= number)
            taken, self.free = self.free[:number], self.free[number:]
            return taken

    def give_back(self, taken):
        with self.changed:
            self.free = sorted(self.free + taken)
            self.changed.notify_all()


def busy_seconds(cores):
    """What the cores have worked so far, for anybody, with what a hypervisor has kept for itself."""
    ticks = 0
    with open("/proc/stat", encoding="utf-8") as file:
        for line in file:
            name, *numbers = line.split()
            if name.startswith("cpu") and name[3:].isdigit() and int(name[3:]) in cores:
                user, nice, system, _, _, interrupt, soft_interrupt, steal = (int(n) for n in numbers[:8])
                ticks += user + nice + system + interrupt + soft_interrupt + steal
    return ticks / os.sysconf("SC_CLK_TCK")
