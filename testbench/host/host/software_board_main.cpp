// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The software board on a pseudo-terminal. It prints the terminal's name, then executes commands
// from stdin until stdin ends: fault N, silent, loud, unplug, crc N, armed?, kicks?, word ADDRESS.
#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

#include "software_board.hpp"

namespace {

int open_terminal() {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0) std::exit(2);
  return master;
}

}  // namespace

int main() {
  std::signal(SIGPIPE, SIG_IGN);
  const int master = open_terminal();
  const std::string name = ::ptsname(master);
  // Kept open without a host: otherwise the terminal hangs up when a host ends.
  int slave = ::open(name.c_str(), O_RDWR | O_NOCTTY);
  termios raw{};
  (void)::tcgetattr(slave, &raw);
  ::cfmakeraw(&raw);
  (void)::tcsetattr(slave, TCSANOW, &raw);
  feltgate::test::SoftwareBoard board(master);
  std::cout << name << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string order;
    int number = 0;
    words >> order >> std::setbase(0) >> number;
    if (order == "fault") board.set_fault(number);
    if (order == "silent") board.set_silent(true);
    if (order == "loud") board.set_silent(false);
    if (order == "unplug") {
      ::close(slave);
      board.unplug();
    }
    if (order == "crc") board.set_design_crc(static_cast<std::uint32_t>(number));
    if (order == "armed?") std::cout << board.armed() << std::endl;
    if (order == "kicks?") std::cout << board.kicks() << std::endl;
    if (order == "word") std::cout << board.word(number) << std::endl;
    if (order != "armed?" && order != "kicks?" && order != "word") std::cout << "ok" << std::endl;
  }
  return 0;
}
