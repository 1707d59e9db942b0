// A workstation: the same programs, for comparison with the boards.
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "port.hpp"

namespace {
int g_argc;
char** g_argv;
FILE* g_file[4];
}  // namespace

namespace port {

bool word(int index, char* text, int size) {
  if (index >= g_argc || strlen(g_argv[index]) >= size_t(size)) return false;
  strcpy(text, g_argv[index]);
  return true;
}

int open(const char* path, bool write) {
  for (int k = 0; k < 4; ++k)
    if (!g_file[k]) {
      g_file[k] = strcmp(path, ":tt") ? fopen(path, write ? "wb" : "rb") : fdopen(dup(1), "wb");
      return g_file[k] ? k : -1;
    }
  return -1;
}

int read(int file, char* bytes, int size) {
  const size_t n = fread(bytes, 1, size_t(size), g_file[file]);
  return ferror(g_file[file]) ? -1 : int(n);
}

bool write(int file, const char* bytes, int size) {
  return fwrite(bytes, 1, size_t(size), g_file[file]) == size_t(size);
}

void close(int file) {
  fclose(g_file[file]);
  g_file[file] = nullptr;
}

void print(const char* text) { fputs(text, stderr); }

Memory memory() { return {0, 0, 0}; }

}  // namespace port

int main(int argc, char** argv) {
  g_argc = argc;
  g_argv = argv;
  return run();
}
