# Install and export come with the package step.
