// Calls into a plug-in. None may throw, and all are to return soon; what does neither must not take the host
// with it.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include "vfit.h"

namespace vfit {

/// What the plug-in answers; VFIT_ERROR_PLUGIN, and `thrown` says what it was, where it throws.
template <typename Call>
vfit_result ask_plugin(std::string& thrown, Call&& call) {
    try {
        return call();
    } catch (const std::exception& e) {
        thrown = std::string("threw an exception: ") + e.what();
    } catch (...) {
        thrown = "threw an exception";
    }
    return VFIT_ERROR_PLUGIN;
}

struct Answer {
    vfit_result result;
    std::string thrown;
};
/// The same on a thread of its own, which is left behind where it does not return in time; false then.
inline bool ask_in_time(std::chrono::milliseconds patience, std::function<vfit_result()> call,
                        Answer& answer) {
    auto promise = std::make_shared<std::promise<Answer>>();
    std::future<Answer> future = promise->get_future();
    std::thread([promise, call = std::move(call)] {
        Answer out{};
        out.result = ask_plugin(out.thrown, call);
        promise->set_value(std::move(out));
    }).detach();
    if (future.wait_for(patience) != std::future_status::ready) return false;
    answer = future.get();
    return true;
}

}  // namespace vfit
