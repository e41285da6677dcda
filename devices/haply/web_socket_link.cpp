#include "devices/haply/web_socket_link.h"

#include <fmt/format.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>

#include "base/error.h"

namespace reachlab::devices {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kConnectPatience{2000}, kSendPatience{200}, kClosePatience{100};
constexpr std::size_t kLargestMessage = 1u << 20;  // [bytes] a service that sends more is none that we know

// Every call is begun asynchronously and waited for with a limit: Beast's own waiting calls know none.
class WebSocketLink final : public MessageLink {
 public:
  WebSocketLink(const std::string& host, std::uint16_t port) : socket_(io_) {
    const std::string where = fmt::format("ws://{}:{}", host, port);
    asio::ip::tcp::resolver resolver(io_);
    beast::error_code fault;
    const auto ends = resolver.resolve(host, std::to_string(port), fault);
    if (fault) throw ResourceError(fmt::format("{}: {}", where, fault.message()));
    auto& tcp = beast::get_lowest_layer(socket_);
    wait(kConnectPatience, fault, [&](auto&& done) { tcp.async_connect(ends, done); });
    if (fault) throw ResourceError(fmt::format("{}: {}", where, fault.message()));
    tcp.socket().set_option(asio::ip::tcp::no_delay(true), fault);
    socket_.read_message_max(kLargestMessage);
    wait(kConnectPatience, fault, [&](auto&& done) { socket_.async_handshake(host, "/", done); });
    if (fault) throw ResourceError(fmt::format("{}: answers, but not as a websocket: {}", where, fault.message()));
    socket_.text(true);
  }

  ~WebSocketLink() override {
    beast::error_code ignored;
    if (!gone_) wait(kClosePatience, ignored, [&](auto&& done) { socket_.async_close(beast::websocket::close_code::normal, done); });
    beast::get_lowest_layer(socket_).socket().close(ignored);
    io_.restart();
    io_.run_for(kClosePatience);  // what was begun ends with the socket closed, before its buffers go
  }

  bool send(std::string_view message) noexcept override try {
    if (gone_) return false;
    sending_.assign(message);
    beast::error_code fault;
    wait(kSendPatience, fault, [&](auto&& done) { socket_.async_write(asio::buffer(sending_), done); });
    if (fault) lose(fault);
    return !gone_;
  } catch (const std::exception& error) {
    lose(error.what());
    return false;
  }

  Got receive(std::string& message, int most) noexcept override try {
    if (gone_) return Got::Gone;
    if (!reading_) {
      reading_ = true;
      read_ = false;
      socket_.async_read(received_, [this](beast::error_code code, std::size_t) {
        readFault_ = code;
        read_ = true;
      });
    }
    turn(std::chrono::milliseconds(most), read_);
    if (!read_) return Got::Nothing;
    reading_ = false;
    if (readFault_) {
      lose(readFault_);
      return Got::Gone;
    }
    message = beast::buffers_to_string(received_.data());
    received_.consume(received_.size());
    return Got::Message;
  } catch (const std::exception& error) {
    lose(error.what());
    return Got::Gone;
  }

  std::string fault() const override { return fault_; }

 private:
  void turn(std::chrono::milliseconds patience, const bool& until) {
    const auto end = Clock::now() + patience;
    io_.restart();
    while (!until && io_.run_one_until(end) > 0) {}
    if (!until) io_.poll();
  }
  template <typename Begin>
  void wait(std::chrono::milliseconds patience, beast::error_code& fault, Begin&& begin) {
    auto done = std::make_shared<bool>(false);
    auto result = std::make_shared<beast::error_code>();
    begin([done, result](beast::error_code code, const auto&... /*what else an operation tells*/) {
      *result = code;
      *done = true;
    });
    turn(patience, *done);
    fault = *done ? *result : beast::error_code(beast::error::timeout);
  }
  void lose(const beast::error_code& code) {
    lose(code == beast::websocket::error::closed ? std::string("the service closed the connection") : code.message());
  }
  void lose(const std::string& why) {
    if (!gone_) fault_ = why;
    gone_ = true;
  }

  asio::io_context io_;
  beast::websocket::stream<beast::tcp_stream, false> socket_;  // without compression, which no service asks for
  beast::flat_buffer received_;
  std::string sending_, fault_;
  beast::error_code readFault_;
  bool reading_ = false, read_ = false, gone_ = false;
};

}  // namespace

std::unique_ptr<MessageLink> openWebSocket(const std::string& host, std::uint16_t port) {
  return std::make_unique<WebSocketLink>(host, port);
}

}  // namespace reachlab::devices
