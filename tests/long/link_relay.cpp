// Joins two network interfaces as a link with delay, jitter and loss: link_relay IFACE IFACE DELAY_MS JITTER_MS LOSS_PERCENT [SEED]
//   or has an interface fill in checksums itself, as no card does on a virtual one: link_relay checksums IFACE
// On standard input, a line each, while it runs: "link DELAY_MS JITTER_MS LOSS_PERCENT" is another link from now on; "cut MS" drops everything
// for so long; "twice PERCENT" sends so many frames twice; "again" sends the last 4,000 frames once more.
// Raw Ethernet, seeded; address resolution goes through at once. Needs CAP_NET_RAW.
#include <arpa/inet.h>
#include <linux/ethtool.h>
#include <linux/if_packet.h>
#include <linux/sockios.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <queue>
#include <random>
#include <string>
#include <vector>
#include <unistd.h>

namespace {

using Clock = std::chrono::steady_clock;

struct Packet {
  Clock::time_point at;
  std::uint64_t number = 0;
  std::size_t to = 0;
  std::vector<char> bytes;
  bool operator<(const Packet& o) const { return at != o.at ? at > o.at : number > o.number; }
};

int openInterface(const char* name) {
  const int descriptor = ::socket(AF_PACKET, SOCK_RAW, htons(ETH_P_ALL));
  sockaddr_ll address{};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(ETH_P_ALL);
  address.sll_ifindex = static_cast<int>(::if_nametoindex(name));
  if (descriptor < 0 || address.sll_ifindex == 0 || ::bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    std::perror(name);
    std::exit(1);
  }
  const int yes = 1;
  ::setsockopt(descriptor, SOL_PACKET, PACKET_IGNORE_OUTGOING, &yes, sizeof yes);
  return descriptor;
}

bool resolvesAddresses(const char* frame, ssize_t size) {
  return size > 13 && static_cast<unsigned char>(frame[12]) == 8 && static_cast<unsigned char>(frame[13]) == 6;
}

/// What can be asked for while it runs.
struct Orders {
  double delay = 0, jitter = 0;  // [ms]
  double loss = 0;               // share
  Clock::time_point cutUntil{};
  double twice = 0;  // share
  bool again = false;

  /// False when nobody is there any more to give any.
  bool read() {
    char text[256];
    const ssize_t size = ::read(0, text, sizeof text);
    if (size <= 0) return false;
    for (ssize_t i = 0; i < size; ++i) {
      if (text[i] != '\n') {
        line_ += text[i];
        continue;
      }
      double number = 0, more = 0, percent = 0;
      if (std::sscanf(line_.c_str(), "link %lf %lf %lf", &number, &more, &percent) == 3)
        delay = number, jitter = more, loss = percent / 100;
      if (std::sscanf(line_.c_str(), "cut %lf", &number) == 1)
        cutUntil = Clock::now() + std::chrono::microseconds(static_cast<long>(1e3 * number));
      if (std::sscanf(line_.c_str(), "twice %lf", &number) == 1) twice = number / 100;
      if (line_ == "again") again = true;
      line_.clear();
    }
    return true;
  }

 private:
  std::string line_;
};

int fillChecksums(const char* name) {
  ethtool_value value{ETHTOOL_STXCSUM, 0};
  ifreq request{};
  std::strncpy(request.ifr_name, name, IFNAMSIZ - 1);
  request.ifr_data = reinterpret_cast<char*>(&value);
  const int descriptor = ::socket(AF_INET, SOCK_DGRAM, 0);
  if (::ioctl(descriptor, SIOCETHTOOL, &request) == 0) return 0;
  std::perror(name);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "checksums") == 0) return fillChecksums(argv[2]);
  if (argc < 6) {
    std::fprintf(stderr, "link_relay IFACE IFACE DELAY_MS JITTER_MS LOSS_PERCENT [SEED]\n");
    return 2;
  }
  ::prctl(PR_SET_TIMERSLACK, 1UL);
  const std::array<int, 2> ends{openInterface(argv[1]), openInterface(argv[2])};
  std::mt19937_64 random(argc > 6 ? std::strtoull(argv[6], nullptr, 10) : 1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::priority_queue<Packet> under;
  std::uint64_t number = 0;
  constexpr std::size_t kKept = 4000;
  std::deque<Packet> kept;
  Orders orders;
  orders.delay = std::atof(argv[3]), orders.jitter = std::atof(argv[4]), orders.loss = std::atof(argv[5]) / 100;
  int from = 0;  // standard input, until it ends
  static std::array<char, 65536> frame;
  while (true) {
    const auto wait = under.empty() ? std::chrono::nanoseconds(std::chrono::seconds(1)) : under.top().at - Clock::now();
    const auto ns = std::max<std::int64_t>(0, std::chrono::duration_cast<std::chrono::nanoseconds>(wait).count());
    const timespec patience{static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
    std::array<pollfd, 3> looks{{{ends[0], POLLIN, 0}, {ends[1], POLLIN, 0}, {from, POLLIN, 0}}};
    ::ppoll(looks.data(), looks.size(), &patience, nullptr);
    if ((looks[2].revents & (POLLIN | POLLHUP)) != 0 && !orders.read()) from = -1;
    if (orders.again) {
      for (const Packet& packet : kept) (void)::send(ends[packet.to], packet.bytes.data(), packet.bytes.size(), 0);
      std::fprintf(stderr, "%zu frames again\n", kept.size());
      orders.again = false;
    }
    for (std::size_t end = 0; end < 2; ++end) {
      if ((looks[end].revents & POLLIN) == 0) continue;
      const ssize_t size = ::recv(ends[end], frame.data(), frame.size(), 0);
      if (size <= 0) continue;
      const bool at_once = resolvesAddresses(frame.data(), size);
      if (Clock::now() < orders.cutUntil) continue;
      if (!at_once && uniform(random) < orders.loss) continue;
      const double ms = at_once ? 0 : std::max(0.0, orders.delay + orders.jitter * (2 * uniform(random) - 1));
      under.push({Clock::now() + std::chrono::nanoseconds(static_cast<std::int64_t>(1e6 * ms)), number++, 1 - end,
                  std::vector<char>(frame.data(), frame.data() + size)});
    }
    while (!under.empty() && under.top().at <= Clock::now()) {
      const Packet packet = under.top();
      under.pop();
      const int times = uniform(random) < orders.twice ? 2 : 1;
      for (int i = 0; i < times; ++i) (void)::send(ends[packet.to], packet.bytes.data(), packet.bytes.size(), 0);
      kept.push_back(packet);
      if (kept.size() > kKept) kept.pop_front();
    }
  }
}
