// port.hpp -- what the programs in this folder need from their surroundings: a command line, files, memory facts.
// port_semihosting.cpp serves emulated boards, port_host.cpp a workstation.
#pragma once
#include <stddef.h>
#include <stdint.h>

namespace port {

/// Copies the word number `index` of the command line (0: program) into text[size], terminated. False: no such word,
/// or it does not fit.
bool word(int index, char* text, int size);

/// Opens a file for reading or (anew) for writing; ":tt" for writing is standard output. Returns a handle, or -1.
int open(const char* path, bool write);
/// Bytes read, 0 at the end of the file, or -1.
int read(int file, char* bytes, int size);
/// True when all bytes went out.
bool write(int file, const char* bytes, int size);
void close(int file);

/// A line or part of one for the person at the terminal.
void print(const char* text);

struct Memory {
  uint32_t static_bytes;  ///< .data and .bss
  uint32_t stack_bytes;   ///< deepest stack since reset; 0 when the port cannot tell
  uint32_t free_bytes;    ///< RAM that was never touched
};
Memory memory();

}  // namespace port

/// Entry of each program; the port calls it. Its result is the exit code.
int run();
