// A plugin for qemu that counts executed instructions. Its interface is declared here, because
// Debian's qemu comes without the header.
#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>

struct block;
extern size_t qemu_plugin_tb_n_insns(const struct block *);
extern void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t, void (*)(uint64_t, struct block *));
extern void qemu_plugin_register_vcpu_tb_exec_cb(
    struct block *, void (*)(unsigned, void *), int flags, void *);
extern void qemu_plugin_register_atexit_cb(uint64_t, void (*)(uint64_t, void *), void *);

int qemu_plugin_version = 1;
// Right for programs of one thread.
static uint64_t executed;

static void execute(unsigned processor, void *instructions) { executed += (uintptr_t)instructions; }

static void translate(uint64_t id, struct block *block) {
    size_t instructions = qemu_plugin_tb_n_insns(block);
    qemu_plugin_register_vcpu_tb_exec_cb(block, execute, 0, (void *)instructions);
}

static void end(uint64_t id, void *unused) { fprintf(stderr, "%" PRIu64 "\n", executed); }

int qemu_plugin_install(uint64_t id, const void *info, int count, char **arguments) {
    qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
    qemu_plugin_register_atexit_cb(id, end, NULL);
    return 0;
}
