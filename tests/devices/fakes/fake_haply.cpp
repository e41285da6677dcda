#include "tests/devices/fakes/fake_haply.h"

#include <sys/socket.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

namespace reachlab::test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Json = nlohmann::json;
using Tcp = asio::ip::tcp;

Json vector(const Vec3& v) { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }

}  // namespace

FakeHaply::FakeHaply(Speaks speaks) : speaks_(speaks) {
  std::atomic<bool> listening{false};
  thread_ = std::thread([this, &listening] {
    asio::io_context io;
    Tcp::acceptor acceptor(io, {asio::ip::make_address("127.0.0.1"), 0});
    port_ = acceptor.local_endpoint().port();
    listener_ = acceptor.native_handle();
    listening = true;
    listening.notify_one();
    while (!ending_) {
      beast::error_code fault;
      Tcp::socket socket(io);
      acceptor.accept(socket, fault);
      if (fault || ending_) break;
      connection_ = socket.native_handle();
      try {
        if (speaks_ == Speaks::NoWebsocket) {
          asio::write(socket, asio::buffer(std::string("220 some other service\r\n")));
          continue;
        }
        socket.set_option(Tcp::no_delay(true));
        beast::websocket::stream<Tcp::socket> stream(std::move(socket));
        stream.accept();
        stream.text(true);
        if (speaks_ == Speaks::ClosesAtOnce) {
          stream.close(beast::websocket::close_code::normal);
          continue;
        }
        bool first = true;
        const auto tell = [&] {
          stream.write(asio::buffer(state(first)));
          first = false;
        };
        if (speaks_ == Speaks::GreetsFirst) tell();
        while (!ending_) {
          beast::flat_buffer message;
          stream.read(message);
          hear(beast::buffers_to_string(message.data()));
          if (!silent) tell();
        }
      } catch (const std::exception&) {  // the client or the test has closed it
      }
      connection_ = -1;
    }
    listener_ = -1;
  });
  listening.wait(false);
}

FakeHaply::~FakeHaply() {
  end();
  thread_.join();
}

void FakeHaply::end() {
  ending_ = true;
  if (const int at = connection_; at >= 0) ::shutdown(at, SHUT_RDWR);
  if (const int at = listener_; at >= 0) ::shutdown(at, SHUT_RDWR);
}

void FakeHaply::moveTo(const Vec3& cursor) {
  const std::lock_guard lock(mutex_);
  cursor_ = cursor;
}

Vec3 FakeHaply::lastForce() const {
  const std::lock_guard lock(mutex_);
  return force_;
}

std::vector<std::string> FakeHaply::firstMessages() const {
  const std::lock_guard lock(mutex_);
  return heard_;
}

void FakeHaply::hear(const std::string& text) {
  const std::lock_guard lock(mutex_);
  constexpr std::size_t kKept = 16;
  if (heard_.size() < kKept) heard_.push_back(text);
  const Json message = Json::parse(text, nullptr, false);
  if (!message.is_object() || !message.contains("inverse3")) return;
  const Json& command = message["inverse3"][0];
  if (command.value("device_id", "") != "049D") return;
  const Json& values = command["commands"]["set_cursor_force"]["values"];
  force_ = {values["x"], values["y"], values["z"]};
  largest_ = std::max(largest_.load(), norm(force_));
  ++forces_;
}

std::string FakeHaply::state(bool first) const {
  const std::lock_guard lock(mutex_);
  if (speaks_ == Speaks::Garbage || garbles) return "\x01\x02 not a message {";
  if (speaks_ == Speaks::OldObjects) return Json{{"inverse3", {{"049D", {{"state", {{"cursor_position", vector(cursor_)}}}}}}}}.dump();
  Json devices = Json::array();
  if (speaks_ != Speaks::NoDevice && !unplugged) {
    Json device = {{"device_id", "049D"}, {"state", {{"cursor_position", vector(cursor_)}, {"cursor_velocity", vector({0.1, 0.2, 0.3})}}}};
    if (first) device["config"] = {{"gravity_compensation", {{"enabled", true}}}, {"handedness", "right"}};
    devices.push_back(device);
  }
  const Json grip = {
      {"device_id", "61548"},
      {"state", {{"orientation", {{"x", 0.0}, {"y", 0.6}, {"z", 0.8}}}, {"buttons", {{"a", true}, {"b", false}, {"c", true}}}}}};
  Json message = {{"inverse3", devices}, {"wireless_verse_grip", Json::array({grip})}};
  message["wireless_verse_grip"][0]["state"]["orientation"]["w"] = 0.0;
  return message.dump();
}

}  // namespace reachlab::test
