// Preloaded before `reach`: the FAULT_AT-th call of FAULT_KIND fails, as a disk or the memory would fail. Without FAULT_AT it only counts; the
// number of calls, and a minus before it when the fault was put in, goes to the file FAULT_COUNT at the end.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <unistd.h>

static atomic_long calls;
static atomic_int injected;
static long faultAt;
static const char* kind;
static int ready;

static void __attribute__((constructor)) begin(void) {
  kind = getenv("FAULT_KIND");
  faultAt = getenv("FAULT_AT") ? atol(getenv("FAULT_AT")) : 0;
  ready = kind != NULL;
}

static void __attribute__((destructor)) end(void) {
  const char* path = getenv("FAULT_COUNT");
  ready = 0;
  if (path == NULL) return;
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  char text[32];
  const int size = snprintf(text, sizeof text, "%s%ld\n", injected ? "-" : "", (long)calls);
  if (file >= 0) {
    if (write(file, text, (size_t)size) < 0) abort();
    close(file);
  }
}

static int fails(const char* what, int fault) {
  if (!ready || strcmp(kind, what) != 0) return 0;
  if (atomic_fetch_add(&calls, 1) + 1 != faultAt) return 0;
  injected = 1;
  // Written at once: a program that dies of the fault runs no destructor.
  errno = fault;
  return 1;
}

#define REAL(name) \
  static __typeof__(&name) real; \
  if (real == NULL) real = (__typeof__(&name))dlsym(RTLD_NEXT, #name)

ssize_t write(int file, const void* data, size_t size) {
  REAL(write);
  return file > 2 && fails("write", ENOSPC) ? -1 : real(file, data, size);
}
ssize_t pread(int file, void* data, size_t size, off_t at) {
  REAL(pread);
  return fails("read", EIO) ? -1 : real(file, data, size, at);
}
ssize_t pread64(int file, void* data, size_t size, off64_t at) {
  REAL(pread64);
  return fails("read", EIO) ? -1 : real(file, data, size, at);
}
ssize_t read(int file, void* data, size_t size) {
  REAL(read);
  return file > 2 && fails("read", EIO) ? -1 : real(file, data, size);
}
int fsync(int file) {
  REAL(fsync);
  return fails("fsync", EIO) ? -1 : real(file);
}
int fdatasync(int file) {
  REAL(fdatasync);
  return fails("fsync", EIO) ? -1 : real(file);
}
int flock(int file, int operation) {
  REAL(flock);
  return fails("lock", ENOLCK) ? -1 : real(file, operation);
}
int rename(const char* from, const char* to) {
  REAL(rename);
  return fails("rename", ENOSPC) ? -1 : real(from, to);
}
static int opens(const char* path, int flags) {
  return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0 || strstr(path, ".reach") != NULL || strstr(path, ".tsv") != NULL ? fails("open", EMFILE) : 0;
}
int open(const char* path, int flags, ...) {
  REAL(open);
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return opens(path, flags) ? -1 : real(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  REAL(open64);
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return opens(path, flags) ? -1 : real(path, flags, mode);
}
void* mmap(void* at, size_t size, int protection, int flags, int file, off_t offset) {
  REAL(mmap);
  return file >= 0 && fails("mmap", ENOMEM) ? MAP_FAILED : real(at, size, protection, flags, file, offset);
}
extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* old, size_t size);
extern void* __libc_memalign(size_t boundary, size_t size);
void* malloc(size_t size) { return fails("malloc", ENOMEM) ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails("malloc", ENOMEM) ? NULL : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return fails("malloc", ENOMEM) ? NULL : __libc_realloc(old, size); }
void* aligned_alloc(size_t boundary, size_t size) { return fails("malloc", ENOMEM) ? NULL : __libc_memalign(boundary, size); }
int posix_memalign(void** place, size_t boundary, size_t size) {
  void* made = fails("malloc", ENOMEM) ? NULL : __libc_memalign(boundary, size);
  if (made == NULL) return ENOMEM;
  *place = made;
  return 0;
}
