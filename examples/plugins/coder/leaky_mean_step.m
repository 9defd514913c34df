function [state, estimate, innovation] = leaky_mean_step(state, gyro_dps, time_constant) %#codegen
% One sample. The state goes in and comes out: a persistent variable would be shared by all instances.
% codegen -config:lib leaky_mean_step -args {struct('mean', 0), 0, 0}
innovation = gyro_dps - state.mean;
state.mean = state.mean + (1 / time_constant) * innovation;
estimate = state.mean;
end
