// SPDX-License-Identifier: LGPL-2.1-or-later
#include "memory.h"
#include "../texts.h"

#include <gtest/gtest.h>
#include <hpvi/algebra/symmetric_matrix.h>
#include <hpvi/base/dense_work.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace algebra;
using namespace hpvi;

/** /proc and /sys of a machine that there is not; each its own, because tests run side by side. */
class Machine
{
public:
  const std::filesystem::path root = std::filesystem::path(::testing::TempDir()) /
                                     ("hpvi-memory-test-" + std::to_string(std::random_device()()));

  Machine()
  {
    write("proc/meminfo", "MemTotal: 9000 kB\nMemAvailable: 3000 kB\nSwapFree: 1000 kB\n");
  }
  ~Machine()
  {
    std::filesystem::remove_all(root);
  }

  void write(const std::string &file, const std::string &content) const
  {
    std::filesystem::create_directories((root / file).parent_path());
    std::ofstream(root / file) << content;
  }
};

/** Of the mapping that holds an address: the flags of the kernel. */
std::string flags_of_mapping(const void *const address)
{
  const auto place = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream file("/proc/self/smaps");
  bool is_here = false;
  for (std::string line; std::getline(file, line);)
  {
    unsigned long begin, end;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2)
      is_here = begin <= place && place < end;
    else if (is_here && line.rfind("VmFlags:", 0) == 0)
      return line + ' ';
  }
  return "";
}

/** What the heap gives, and gives again, lies in large pages. */
TEST(Memory, HeapOfLargePages)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer has its own heap";
#endif
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage"))
    GTEST_SKIP() << "the kernel has no large pages";
  reserve_heap();
  const std::size_t size = 20'000'000;
  for (unsigned int pass = 0; pass < 2; ++pass)
  {
    const std::vector<char> block(size);
    EXPECT_NE(flags_of_mapping(block.data() + size / 2).find(" hg "), std::string::npos) << pass;
  }
}

TEST(Memory, OfTheMachine)
{
  const Machine machine;
  EXPECT_EQ(available_memory(machine.root).bytes, 4000 * 1024.);
  EXPECT_EQ(available_memory(machine.root).limit, "the machine's memory");
}

TEST(Memory, OfNoMachine)
{
  EXPECT_EQ(available_memory("/no/such/directory").bytes, std::numeric_limits<double>::infinity());
}

/** The parent allows less than the group itself; what is cached of files does not count. */
TEST(Memory, OfControlGroups)
{
  const Machine machine;
  machine.write("proc/self/cgroup", "0::/outer/inner\n");
  machine.write("sys/fs/cgroup/outer/inner/memory.max", "max\n");
  machine.write("sys/fs/cgroup/outer/inner/memory.current", "500000\n");
  machine.write("sys/fs/cgroup/outer/memory.max", "900000\n");
  machine.write("sys/fs/cgroup/outer/memory.current", "600000\n");
  machine.write("sys/fs/cgroup/outer/memory.stat", "anon 400000\ninactive_file 200000\n");
  EXPECT_EQ(available_memory(machine.root).bytes, 500000);
  EXPECT_EQ(available_memory(machine.root).limit, "the control group");
}

/** Version 1, in a container: the group's path is the one outside, its files are at the root. */
TEST(Memory, OfTheGroupOfAContainer)
{
  const Machine machine;
  machine.write("proc/self/cgroup", "7:cpu:/elsewhere\n4:memory:/outside/container\n");
  machine.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "900000\n");
  machine.write("sys/fs/cgroup/memory/memory.usage_in_bytes", "950000\n");
  machine.write("sys/fs/cgroup/memory/memory.stat", "total_inactive_file 60000\n");
  EXPECT_EQ(available_memory(machine.root).bytes, 10000);
}

TEST(Memory, OfTheAddressSpace)
{
  if (!AddressSpaceLimit::can_be_tested())
    GTEST_SKIP();
  EXPECT_NO_THROW(require_memory(1e6, "nothing much"));
  const AddressSpaceLimit limit(64e6);
  EXPECT_LE(available_memory().bytes, 64e6);
  EXPECT_GT(available_memory().bytes, 32e6);
  const std::string failure =
      failure_of<NumericalFailure>([] { require_memory(65e6, "the test"); });
  EXPECT_EQ(failure.find("the test needs 65 MB of memory, "), 0u) << failure;
  EXPECT_NE(failure.find("are left of the address space (ulimit -v)"), std::string::npos);
}

/** What a thread has asked for last is granted to no other before it is given back, or the thread ends. */
TEST(Memory, IsGrantedOnce)
{
  const double some = 0.6 * available_memory().bytes;
  const auto is_granted_to_another = [&]()
  {
    bool granted = false;
    std::thread(
        [&]() {
          granted = failure_of<NumericalFailure>([&] { require_memory(some, "another"); }).empty();
        })
        .join();
    return granted;
  };
  EXPECT_TRUE(is_granted_to_another());
  EXPECT_TRUE(is_granted_to_another());
  require_memory(some, "the test");
  EXPECT_FALSE(is_granted_to_another());
  require_memory(some, "the next thing in the same thread");
  EXPECT_FALSE(is_granted_to_another());
  EXPECT_THROW(require_memory(2 * some, "what there is not"), MemoryFailure);
  EXPECT_TRUE(is_granted_to_another());
  require_memory(some, "the test");
  forget_memory_claim();
  EXPECT_TRUE(is_granted_to_another());
}

/** OpenBLAS would wait for its buffer for ever. */
TEST(Memory, OfTheBlas)
{
  if (!AddressSpaceLimit::can_be_tested())
    GTEST_SKIP();
  const AddressSpaceLimit limit(64e6);
  EXPECT_NE(failure_of<NumericalFailure>(prepare_blas).find("OpenBLAS needs 134 MB of memory"),
            std::string::npos);
}

TEST(Memory, InWords)
{
  EXPECT_EQ(bytes_text(0), "0 B");
  EXPECT_EQ(bytes_text(999), "999 B");
  EXPECT_EQ(bytes_text(1000), "1 kB");
  EXPECT_EQ(bytes_text(999999), "1 MB");
  EXPECT_EQ(bytes_text(4.2e9), "4.2 GB");
  EXPECT_EQ(bytes_text(1.5e16), "1.5e+04 TB");
}

/** One entry more than an int counts, and what fits the index but no machine. */
TEST(SymmetricMatrix, RefusesWhatItCannotCount)
{
  SymmetricMatrix A;
  EXPECT_NE(
      failure_of<NumericalFailure>([&] { A.resize(2147483648); }).find("has 2147483648 entries"),
      std::string::npos);
  if (AddressSpaceLimit::can_be_tested())
  {
    const AddressSpaceLimit limit(64e6);
    EXPECT_NE(failure_of<NumericalFailure>([&] { A.resize(2147483647); })
                  .find("the stiffness matrix needs 25.8 GB"),
              std::string::npos);
  }
  EXPECT_TRUE(A.row.empty());
  A.resize(3);
  EXPECT_EQ(A.row.size(), 3u);
  EXPECT_EQ(A.value.size(), 3u);
}

/** Counts whose squares overflow 32 bits. */
TEST(DenseWork, CountsBeyond32Bits)
{
  const DenseWork dense{100000, 70000};
  EXPECT_EQ(dense.bytes(), 8 * (7e9 + 1e10 + 4.9e9));
  EXPECT_EQ((DenseWork{10, 10}).bytes(), 8 * 400.);
  EXPECT_NEAR(dense.seconds(), (1e15 / 3 + 7e14 + 4.9e14 + 3.43e14 / 3) / 2e10, 1e-3);
}

TEST(DenseWork, SaysWhatTakesLong)
{
  EXPECT_EQ((DenseWork{1000, 700}).note(), "");
  const std::string note = DenseWork{3000, 2000}.note();
  EXPECT_NE(note.find("2000 multipliers takes 152 MB and about 2.1 s"), std::string::npos) << note;
}
} // namespace
