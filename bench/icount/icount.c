/* icount.c -- a QEMU plugin that counts the instructions of marked regions, exactly.
 *
 *   gcc -shared -fPIC -o libicount.so icount.c
 *   qemu-system-arm ... -plugin file=./libicount.so,out=counts.txt
 *
 * A region runs from the instruction `mov r9, r9` to `mov r10, r10` (RISC-V: `addi x0, x0, 1` and `addi x0, x0, 2`),
 * which no compiler emits; the two are not counted. counts.txt gets one line per region, in the order they ended.
 * Debian ships no qemu-plugin.h: the few functions used are declared here, as of plugin API version 1 (QEMU 4.2 .. 8).
 */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef uint64_t plugin_id;
typedef struct {
  const char *target_name; /* "arm", "riscv32"; what follows is not used */
} plugin_info;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { INLINE_ADD_U64 = 0, CB_NO_REGS = 0 };

size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *tb);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *tb, size_t index);
const void *qemu_plugin_insn_data(const struct qemu_plugin_insn *insn);
size_t qemu_plugin_insn_size(const struct qemu_plugin_insn *insn);
void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id id, void (*translated)(plugin_id, struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *insn, int operation, void *target, uint64_t add);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *insn, void (*executed)(unsigned, void *), int flags,
                                            void *data);
void qemu_plugin_register_atexit_cb(plugin_id id, void (*ended)(plugin_id, void *), void *data);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

static uint64_t executed_instructions;
static uint64_t region_start;
static uint32_t begin_code, end_code;
static size_t code_size;
static FILE *out;

static void begin(unsigned cpu, void *data) {
  (void)cpu, (void)data;
  region_start = executed_instructions;
}

static void end(unsigned cpu, void *data) {
  (void)cpu, (void)data;
  fprintf(out, "%llu\n", (unsigned long long)(executed_instructions - region_start));
}

static uint32_t code_of(const struct qemu_plugin_insn *insn) {
  uint32_t code = 0;
  if (qemu_plugin_insn_size(insn) == code_size) memcpy(&code, qemu_plugin_insn_data(insn), code_size);
  return code;
}

static void translated(plugin_id id, struct qemu_plugin_tb *tb) {
  (void)id;
  for (size_t k = 0; k < qemu_plugin_tb_n_insns(tb); ++k) {
    struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(tb, k);
    if (code_of(insn) == begin_code)
      qemu_plugin_register_vcpu_insn_exec_cb(insn, begin, CB_NO_REGS, NULL);
    else if (code_of(insn) == end_code)
      qemu_plugin_register_vcpu_insn_exec_cb(insn, end, CB_NO_REGS, NULL);
    else
      qemu_plugin_register_vcpu_insn_exec_inline(insn, INLINE_ADD_U64, &executed_instructions, 1);
  }
}

static void ended(plugin_id id, void *data) {
  (void)id, (void)data;
  fclose(out);
}

__attribute__((visibility("default"))) int qemu_plugin_install(plugin_id id, const plugin_info *info, int argc, char **argv) {
  const int arm = !strcmp(info->target_name, "arm");
  code_size = arm ? 2 : 4;
  begin_code = arm ? 0x46C9u : 0x00100013u;
  end_code = arm ? 0x46D2u : 0x00200013u;
  for (int k = 0; k < argc; ++k)
    if (!strncmp(argv[k], "out=", 4)) out = fopen(argv[k] + 4, "w");
  if (!out) {
    fprintf(stderr, "icount: needs out=FILE, a file that can be written\n");
    return 1;
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, ended, NULL);
  return 0;
}
