// Preloaded into a program, this lets it be loaded once and run many times. To find the symbols of
// two hundred libraries takes a third of a second, which is most of what a `--check` takes; a copy
// of the process that has found them (fork) takes nothing. The program itself is as it ships.
//
// On standard input come the runs: for each its number of arguments, then the arguments, the
// directory, and the files for standard output and standard error, each ended by a zero byte. For
// each run a line with its wait status goes to standard output. loaded_once.py speaks to this.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using Main = int (*)(int, char **, char **);
Main real_main = nullptr;


std::string next_word()
{
  std::string word;
  std::getline(std::cin, word, '\0');
  return word;
}


void redirect(const int descriptor, const std::string &file, const int flags)
{
  const int opened = open(file.c_str(), flags, 0666);
  if (opened < 0 || dup2(opened, descriptor) < 0)
    _exit(127);
  close(opened);
}


int run_one(const std::string &program, const int n_arguments, char **environment)
{
  std::vector<std::string> words{program};
  for (int i = 0; i < n_arguments; ++i)
    words.push_back(next_word());
  const std::string directory = next_word(), out = next_word(), err = next_word();

  const pid_t child = fork();
  if (child == 0)
  {
    if (chdir(directory.c_str()) != 0)
      _exit(127);
    redirect(0, "/dev/null", O_RDONLY);
    redirect(1, out, O_WRONLY | O_CREAT | O_TRUNC);
    redirect(2, err, O_WRONLY | O_CREAT | O_TRUNC);
    std::vector<char *> arguments;
    for (std::string &word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::exit(real_main(n_arguments + 1, arguments.data(), environment));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}


int serve(int, char **arguments, char **environment)
{
  unsetenv("LD_PRELOAD"); // programs that a run starts are not meant
  for (std::string number = next_word(); !number.empty(); number = next_word())
  {
    std::printf("%d\n", run_one(arguments[0], std::stoi(number), environment));
    std::fflush(stdout);
  }
  return 0;
}
} // namespace


// What the C library's start-up code calls when all is loaded.
extern "C" int __libc_start_main(Main main,
                                 int n_arguments,
                                 char **arguments,
                                 void (*init)(),
                                 void (*fini)(),
                                 void (*rtld_fini)(),
                                 void *stack_end)
{
  real_main = main;
  using Start = int (*)(Main, int, char **, void (*)(), void (*)(), void (*)(), void *);
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(serve, n_arguments, arguments, init, fini, rtld_fini, stack_end);
}
