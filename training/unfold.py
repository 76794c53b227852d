"""Weights out of an exported ONNX file back into a network that can be trained further."""

import onnx
import torch
from onnx import numpy_helper

from network import Network


@torch.no_grad()
def from_onnx(path, crops):
    """export.py folds batch norms into the convolutions before them. Here each norm gets back the spread that
    its convolution has on `crops` [n, 1, CROP, CROP], and such a scale and shift that the network says what
    the file says. A convolution that the file does not have yet starts as no change."""
    weights = {
        w.name: torch.from_numpy(numpy_helper.to_array(w).copy())
        for w in onnx.load(str(path)).graph.initializer
    }
    network = Network()
    for name, parameter in network.named_parameters():
        if name in weights:
            parameter.copy_(weights[name])

    def give_back(name):
        def hook(norm, inputs):
            spread, mean = torch.var_mean(inputs[0], (0, 2, 3), correction=0)
            norm.running_mean.copy_(mean)
            norm.running_var.copy_(spread)
            norm.weight.copy_((spread + norm.eps).sqrt())
            norm.bias.copy_(mean + weights[f"{name}.0.bias"])

        return hook

    hooks = [
        module[1].register_forward_pre_hook(give_back(name))
        for name, module in network.named_modules()
        if f"{name}.0.bias" in weights
    ]
    network.eval()(crops)
    for hook in hooks:
        hook.remove()
    return network
