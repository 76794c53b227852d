#include "device.h"
#include "support/table.h"

vfit_result vfit_plugin_negotiate(const vfit_host* host, vfit_plugin* out) {
    return plugin::Table<recording::Device>::negotiate(host, out);
}
