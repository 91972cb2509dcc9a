// Preloaded into a program, this lets it be loaded once and run many times. To load two hundred
// libraries takes nearly half a second, which is most of what a short test takes; a copy of the
// process that has loaded them (fork) takes nothing. The program itself is as it ships.
//
// The server listens at the Unix socket whose name (an abstract one) is in LOADED_ONCE. A client
// sends the files for standard output and standard error, then words that are each ended by a zero
// byte: the number of arguments and the arguments, the directory, and the environment; then it ends
// its side. It is sent the process's number and, when that has ended, its wait status, a line each.
// A client that goes away takes its run with it. loaded_once.py speaks to this.
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace
{
using Main = int (*)(int, char **, char **);
Main real_main = nullptr;

constexpr int patience = 60000; // without a client for so long [ms], the server ends


/** What tells whether the program and its libraries are still those that were loaded. Of the
   program, whose link leads to what was loaded, the number of names: none when it has been
   replaced. */
std::string state_of_files()
{
  std::string state;
  const auto append = [](dl_phdr_info *library, std::size_t, void *all)
  {
    struct stat file;
    if (stat(library->dlpi_name[0] == 0 ? "/proc/self/exe" : library->dlpi_name, &file) == 0)
      *static_cast<std::string *>(all) += std::to_string(file.st_ino) + ' ' +
                                          std::to_string(file.st_mtim.tv_sec) + ' ' +
                                          std::to_string(file.st_nlink) + '\n';
    return 0;
  };
  dl_iterate_phdr(append, &state);
  return state;
}


int listen_at(const std::string &name)
{
  const int listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.size() >= sizeof(address.sun_path) - 1)
    return -1;
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  const socklen_t length = offsetof(sockaddr_un, sun_path) + 1 + name.size();
  const bool bound = bind(listener, reinterpret_cast<sockaddr *>(&address), length) == 0 &&
                     listen(listener, 64) == 0;
  return bound ? listener : -1;
}


/** A socket in an abstract place is open to everyone on the machine. */
bool is_of_this_user(const int client)
{
  ucred peer{};
  socklen_t length = sizeof(peer);
  return getsockopt(client, SOL_SOCKET, SO_PEERCRED, &peer, &length) == 0 && peer.uid == geteuid();
}


struct Request
{
  std::array<int, 2> files{{-1, -1}};
  std::vector<std::string> arguments, environment;
  std::string directory;
};


Request read_request(const int client, const std::string &program)
{
  std::array<char, 65536> buffer;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Request::files))> control;
  iovec part{buffer.data(), buffer.size()};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();

  Request request;
  ssize_t n = recvmsg(client, &message, MSG_CMSG_CLOEXEC);
  if (const cmsghdr *head = CMSG_FIRSTHDR(&message);
      n > 0 && head != nullptr && head->cmsg_len == CMSG_LEN(sizeof(request.files)))
    std::memcpy(request.files.data(), CMSG_DATA(head), sizeof(request.files));
  std::vector<std::string> words(1);
  for (; n > 0; n = read(client, buffer.data(), buffer.size()))
    for (ssize_t i = 0; i < n; ++i)
      if (buffer[i] == 0)
        words.emplace_back();
      else
        words.back() += buffer[i];
  words.pop_back();
  const std::size_t n_arguments = words.empty() ? 0 : std::stoul(words[0]);
  if (words.size() < n_arguments + 2 || request.files[0] < 0)
    _exit(127);
  request.arguments = {program};
  request.arguments.insert(request.arguments.end(), words.begin() + 1,
                           words.begin() + 1 + n_arguments);
  request.directory = words[1 + n_arguments];
  request.environment.assign(words.begin() + 2 + n_arguments, words.end());
  return request;
}


std::vector<char *> pointers_to(std::vector<std::string> &words)
{
  std::vector<char *> pointers;
  for (std::string &word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}


[[noreturn]] void run(Request &request)
{
  const int nothing = open("/dev/null", O_RDONLY);
  if (chdir(request.directory.c_str()) != 0 || dup2(nothing, 0) < 0 ||
      dup2(request.files[0], 1) < 0 || dup2(request.files[1], 2) < 0)
    _exit(127);
  auto arguments = pointers_to(request.arguments);
  auto environment = pointers_to(request.environment);
  environ = environment.data();
  std::exit(real_main(arguments.size() - 1, arguments.data(), environ));
}


void send_line(const int client, const int number)
{
  const std::string line = std::to_string(number) + '\n';
  send(client, line.data(), line.size(), MSG_NOSIGNAL);
}


/** In a process of its own: starts the run, waits for its end, or for that of the client. */
[[noreturn]] void attend(const int client, const std::string &program)
{
  std::signal(SIGCHLD, [](int) {});
  sigset_t children, none;
  sigemptyset(&none);
  sigemptyset(&children);
  sigaddset(&children, SIGCHLD);
  sigprocmask(SIG_BLOCK, &children, nullptr); // but while it waits

  Request request = read_request(client, program);
  const pid_t child = fork();
  if (child == 0)
  {
    std::signal(SIGCHLD, SIG_DFL);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    close(client);
    run(request);
  }
  send_line(client, child);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0)
  {
    pollfd gone{client, 0, 0};
    if (ppoll(&gone, 1, nullptr, &none) > 0)
      kill(child, SIGKILL);
  }
  send_line(client, status);
  _exit(0);
}


int serve(int, char **arguments, char **)
{
  const char *name = std::getenv("LOADED_ONCE");
  const int listener = listen_at(name != nullptr ? name : "");
  if (listener < 0)
    return 0; // another one was first
  std::signal(SIGCHLD, SIG_IGN);
  const std::string loaded = state_of_files();
  for (pollfd asked{listener, POLLIN, 0}; poll(&asked, 1, patience) > 0;)
  {
    const int client = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
    if (state_of_files() != loaded)
      break; // the program was built anew; the client starts it
    if (client >= 0 && is_of_this_user(client) && fork() == 0)
    {
      close(listener);
      attend(client, arguments[0]);
    }
    close(client);
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
