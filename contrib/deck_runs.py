"""One deck after the other, for the scripts: what is finished stays as it is, what was begun goes on from its checkpoint."""
import os
import subprocess

from results import ResultError, read_summary


def finished(directory):
    try:
        return read_summary(directory).get("status") == "finished"
    except ResultError:
        return False


def run_deck(program, deck, directory, settings):
    """Whether the run in a directory has come to its end, now or before. What the program prints is in its file `log`."""
    settings_path = os.path.join(directory, "settings")
    wanted = "; ".join(settings)
    if finished(directory):
        if os.path.exists(settings_path):
            with open(settings_path, encoding="utf-8") as file:
                if (there := file.read()) != wanted:
                    raise ResultError(f"'{directory}' has a finished run with the settings '{there}', not '{wanted}': "
                                      "give another --output, or remove it")
        print(f"{directory}: finished before")
        return True
    os.makedirs(directory, exist_ok=True)
    with open(settings_path, "w", encoding="utf-8") as file:
        file.write(wanted)
    command = [program, deck, "--output", directory]
    for setting in settings:
        command += ["--set", setting]
    if os.path.isdir(os.path.join(directory, "checkpoint")):
        command.append("--restart")
    log_path = os.path.join(directory, "log")
    with open(log_path, "a", encoding="utf-8") as log:
        status = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False, stdin=subprocess.DEVNULL,
                                env=dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                                         DEAL_II_NUM_THREADS="1")).returncode
    print(f"{directory}: " + ("finished" if status == 0 else f"exit status {status}, see {log_path}"), flush=True)
    return status == 0
