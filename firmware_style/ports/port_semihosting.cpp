// Arm semihosting: the emulator carries out the request in a register. Same requests on Arm and RISC-V.
#include "port.hpp"
#include "startup.h"

namespace {

enum Request : int {
  sys_open = 0x01,
  sys_close = 0x02,
  sys_write0 = 0x04,
  sys_write = 0x05,
  sys_read = 0x06,
  sys_get_cmdline = 0x15,
  sys_exit_extended = 0x20
};

using Word = intptr_t;

Word request(Request operation, const void* argument) {
#if defined(__arm__)
  register Word r0 __asm("r0") = operation;
  register const void* r1 __asm("r1") = argument;
  __asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
#else
  register Word a0 __asm("a0") = operation;
  register const void* a1 __asm("a1") = argument;
  __asm volatile(  // the three must share a page and be uncompressed
      ".option push\n .option norvc\n .balign 16\n slli x0, x0, 0x1f\n ebreak\n srai x0, x0, 7\n .option pop"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return a0;
#endif
}

Word address(const void* p) { return reinterpret_cast<Word>(p); }

int length(const char* text) {
  int n = 0;
  while (text[n]) ++n;
  return n;
}

}  // namespace

extern "C" void semihosting_exit(int code) {
  const Word block[2] = {0x20026, code};  // ADP_Stopped_ApplicationExit
  for (;;) request(sys_exit_extended, block);
}

namespace port {

bool word(int index, char* text, int size) {
  static char line[256];
  if (!line[0]) {
    Word block[2] = {address(line), Word(sizeof line)};
    if (request(sys_get_cmdline, block)) return false;
  }
  const char* at = line;
  for (; *at && index; --index) {
    while (*at && *at != ' ') ++at;
    while (*at == ' ') ++at;
  }
  int n = 0;
  for (; at[n] && at[n] != ' ' && n < size; ++n) text[n] = at[n];
  if (n == 0 || n == size) return false;
  text[n] = 0;
  return true;
}

int open(const char* path, bool write) {
  const Word block[3] = {address(path), write ? 5 : 1, length(path)};  // modes "wb" and "rb"
  return int(request(sys_open, block));
}

int read(int file, char* bytes, int size) {
  const Word block[3] = {file, address(bytes), size};
  return size - int(request(sys_read, block));
}

bool write(int file, const char* bytes, int size) {
  const Word block[3] = {file, address(bytes), size};
  return request(sys_write, block) == 0;
}

void close(int file) {
  const Word block[1] = {file};
  request(sys_close, block);
}

void print(const char* text) { request(sys_write0, text); }

Memory memory() {
  const uint32_t* lowest = bss_end;
  while (lowest < stack_top && *lowest == STACK_PAINT) ++lowest;
  const auto bytes = [](const uint32_t* from, const uint32_t* to) {
    return uint32_t(address(to) - address(from));
  };
  return {bytes(data_begin, bss_end), bytes(lowest, stack_top), bytes(bss_end, lowest)};
}

}  // namespace port

int main() { return run(); }
