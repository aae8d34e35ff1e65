// What a submission must not do is made impossible before its first line runs: new programs and
// processes, sockets, files, signals to others. The limits of time and memory are set from outside.
//
// On Linux a filter in the kernel refuses these calls (seccomp). Elsewhere there is no such filter,
// and `photon-mapping check` says so.

#include "recorder.hpp"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

namespace {

char* top_of_stack = nullptr;
bool is_guarded = false;
int plan = -1;

// Whoever does not ask whether malloc() gave memory crashes where there is none left.
bool memory_is_used_up() {
    rlimit limit;
    rusage used;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
        getrusage(RUSAGE_SELF, &used) != 0) {
        return false;
    }
#ifdef __APPLE__
    const rlim_t bytes = static_cast<rlim_t>(used.ru_maxrss);
#else
    const rlim_t bytes = static_cast<rlim_t>(used.ru_maxrss) * 1024;
#endif
    return bytes > limit.rlim_cur / 4 * 3;
}

// A stack that overflowed cannot run this handler, so it has a stack of its own.
void on_segmentation_fault(int, siginfo_t* about, void*) {
    const char* const at = static_cast<const char*>(about->si_addr);
    rlimit limit;
    const bool has_limit =
        getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    const std::size_t size = has_limit ? static_cast<std::size_t>(limit.rlim_cur) : 8u << 20;
    const std::size_t margin = 1u << 20;
    if (at < top_of_stack && at + size + margin > top_of_stack) {
        photon_check::stack_overflowed();
    } else if (memory_is_used_up()) {
        photon_check::memory_ran_out();
    }
    std::signal(SIGSEGV, SIG_DFL);
    std::raise(SIGSEGV);
}

} // namespace

namespace photon_check {

// Processor time, since a busy machine must not make honest code look endless.
void give_processor_time(unsigned seconds) {
    itimerval time = {};
    time.it_value.tv_sec = static_cast<time_t>(seconds);
    setitimer(ITIMER_PROF, &time, nullptr);
}

void watch_the_stack() {
    char here;
    top_of_stack = &here;
    static char own_stack[1 << 16];
    stack_t stack = {};
    stack.ss_sp = own_stack;
    stack.ss_size = sizeof own_stack;
    struct sigaction action = {};
    action.sa_sigaction = on_segmentation_fault;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    if (sigaltstack(&stack, nullptr) == 0) {
        sigaction(SIGSEGV, &action, nullptr);
        sigaction(SIGBUS, &action, nullptr);
    }
}

} // namespace photon_check

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))

#include <cerrno>
#include <cstddef>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace {

#ifdef __x86_64__
const unsigned architecture = AUDIT_ARCH_X86_64;
#else
const unsigned architecture = AUDIT_ARCH_AARCH64;
#endif

// Lower and upper half of a system call's argument.
unsigned low_half(int argument) {
    return static_cast<unsigned>(offsetof(seccomp_data, args)) + 8u * static_cast<unsigned>(argument);
}
unsigned high_half(int argument) { return low_half(argument) + 4; }

class Filter {
public:
    Filter() : length(0) {}

    void load(unsigned offset) { add(BPF_LD | BPF_W | BPF_ABS, 0, 0, offset); }
    void load_number() { load(static_cast<unsigned>(offsetof(seccomp_data, nr))); }
    void answer(unsigned what) { add(BPF_RET | BPF_K, 0, 0, what); }
    // The next `count` instructions are skipped where the loaded number is not `number`.
    void unless_equal_skip(unsigned number, unsigned char count) {
        add(BPF_JMP | BPF_JEQ | BPF_K, 0, count, number);
    }
    void if_equal_skip(unsigned number, unsigned char count) {
        add(BPF_JMP | BPF_JEQ | BPF_K, count, 0, number);
    }
    // Refuses all calls from `number` on.
    void refuse_from(unsigned number) {
        add(BPF_JMP | BPF_JGE | BPF_K, 0, 1, number);
        answer(SECCOMP_RET_ERRNO | EPERM);
    }
    void refuse(long call, int error = EPERM) {
        unless_equal_skip(static_cast<unsigned>(call), 1);
        answer(SECCOMP_RET_ERRNO | static_cast<unsigned>(error));
    }
    // Refuses `call` where no bit of `bits` is set in its argument.
    void refuse_without_bits(long call, int argument, unsigned bits) {
        unless_equal_skip(static_cast<unsigned>(call), 4);
        load(low_half(argument));
        add(BPF_JMP | BPF_JSET | BPF_K, 1, 0, bits);
        answer(SECCOMP_RET_ERRNO | EPERM);
        answer(SECCOMP_RET_ALLOW);
    }
    // Refuses `call` unless the lower half of its argument is `number`.
    void refuse_unless(long call, int argument, unsigned number) {
        unless_equal_skip(static_cast<unsigned>(call), 4);
        load(low_half(argument));
        add(BPF_JMP | BPF_JEQ | BPF_K, 1, 0, number);
        answer(SECCOMP_RET_ERRNO | EPERM);
        answer(SECCOMP_RET_ALLOW);
    }
    // Refuses `call` unless its argument is a null pointer.
    void refuse_unless_null(long call, int argument) {
        unless_equal_skip(static_cast<unsigned>(call), 6);
        load(low_half(argument));
        add(BPF_JMP | BPF_JEQ | BPF_K, 0, 2, 0);
        load(high_half(argument));
        add(BPF_JMP | BPF_JEQ | BPF_K, 1, 0, 0);
        answer(SECCOMP_RET_ERRNO | EPERM);
        answer(SECCOMP_RET_ALLOW);
    }
    bool install() {
        sock_fprog program = {static_cast<unsigned short>(length), instructions};
        return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
               prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
    }

private:
    void add(int code, int if_true, int if_false, unsigned number) {
        const sock_filter instruction = {
            static_cast<unsigned short>(code), static_cast<unsigned char>(if_true),
            static_cast<unsigned char>(if_false), number};
        instructions[length++] = instruction;
    }

    int length;
    sock_filter instructions[256];
};

void guard(int argc, char** argv, char**) {
    // As much as a step has, for constructors of static objects.
    photon_check::give_processor_time(argc > 4 ? static_cast<unsigned>(std::atoi(argv[4])) : 3);
    photon_check::open_pipe();
    // No file can be opened after this.
    if (argc > 1) {
        plan = open(argv[1], O_RDONLY | O_CLOEXEC);
    }
    // Whoever ends the checker ends this program, too.
    prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
    Filter filter;
    filter.load(static_cast<unsigned>(offsetof(seccomp_data, arch)));
    filter.if_equal_skip(architecture, 1);
    filter.answer(SECCOMP_RET_KILL_PROCESS);
    filter.load_number();
#ifdef __x86_64__
    filter.refuse(SYS_fork);
    filter.refuse(SYS_vfork);
    filter.refuse(SYS_creat);
    filter.refuse(SYS_unlink);
    filter.refuse(SYS_rename);
    filter.refuse(SYS_mkdir);
    filter.refuse(SYS_rmdir);
    filter.refuse(SYS_link);
    filter.refuse(SYS_symlink);
    filter.refuse(SYS_chmod);
    filter.refuse(SYS_chown);
    filter.refuse(SYS_lchown);
    filter.refuse(SYS_mknod);
    filter.refuse(SYS_open, EACCES);
    // The same calls again, under the numbers of the x32 interface.
    filter.refuse_from(0x40000000u);
#endif
    const long refused[] = {
        SYS_execve,   SYS_execveat,     SYS_socket,    SYS_socketpair, SYS_connect,
        SYS_bind,     SYS_unlinkat,     SYS_renameat2, SYS_mkdirat,    SYS_linkat,
        SYS_symlinkat, SYS_fchmod,      SYS_fchmodat,  SYS_fchown,     SYS_fchownat,
        SYS_mknodat,  SYS_truncate,     SYS_ptrace,    SYS_process_vm_writev, SYS_setsid,
        SYS_process_vm_readv, SYS_open_by_handle_at,
        SYS_setpgid,  SYS_setrlimit,    SYS_unshare,   SYS_setns,      SYS_mount,
        SYS_tkill,    SYS_rt_sigqueueinfo, SYS_utimensat, SYS_setxattr, SYS_io_setup,
        SYS_shmget,   SYS_msgget,       SYS_mq_open,
#ifdef SYS_renameat
        SYS_renameat,
#endif
#ifdef SYS_openat2
        SYS_openat2,
#endif
#ifdef SYS_io_uring_setup
        SYS_io_uring_setup,
#endif
    };
    for (long call : refused) {
        filter.refuse(call);
    }
#ifdef SYS_clone3
    // Its arguments cannot be looked at. The C library then takes clone.
    filter.refuse(SYS_clone3, ENOSYS);
#endif
    filter.refuse_without_bits(SYS_clone, 0, CLONE_THREAD);
    filter.refuse(SYS_openat, EACCES);
    filter.refuse_unless_null(SYS_prlimit64, 2);
    const unsigned self = static_cast<unsigned>(getpid());
    filter.refuse_unless(SYS_kill, 0, self);
    filter.refuse_unless(SYS_tgkill, 0, self);
    filter.answer(SECCOMP_RET_ALLOW);
    is_guarded = filter.install();
}

// The linker's list of functions that run before any constructor.
__attribute__((section(".preinit_array"), used)) void (*const guard_first)(int, char**, char**) =
    guard;

} // namespace

#endif

namespace photon_check {

bool system_calls_are_filtered() { return is_guarded; }

int open_plan(const char* path) { return plan >= 0 ? plan : open(path, O_RDONLY | O_CLOEXEC); }

} // namespace photon_check
