// What the program's exit status means. Numbers of sysexits.h, so that scripts can tell a retry from a lost cause.
#pragma once

namespace norrsken::cli {

enum class ExitStatus : int {
  done = 0,
  usage = 64,          ///< the command line is wrong
  data_error = 65,     ///< a scene or an image was read, and what it says is wrong
  no_input = 66,       ///< a scene or an image is missing or cannot be read
  internal = 70,       ///< a fault of the program
  cannot_create = 73,  ///< an output cannot be created, found before any work was done
  io_error = 74,       ///< writing failed
  interrupted = 77,    ///< stopped by a signal, after saving what there is
};

}  // namespace norrsken::cli
