{{heading}}
%
% {{name}}.motion(K, M), {{name}}.rates(y, M), {{name}}.momentum_of(w), {{name}}.status(y, M), {{name}}.energy(K);
% with an integrator: ode45(@(t, y) {{name}}.rates(y, [0; 0; 0]), [0 60], {{name}}.start())
classdef {{name}}
    methods (Static)
        function y = start()
            % Angular momentum (N m s, body axes) and quaternion of the start of the model.
            y = {{start}}';
        end

        function [w, rate, power] = motion(K, M)
            % Angular velocity (rad/s), rate of the angular momentum (N m), body axes; power dissipated (W).
            K = K(:);
            M = M(:);
            g = {{name}}.energy_gradient(K);
            c = {{name}}.internal_momenta(K);
            T = {{name}}.dissipation(K);
            v = cross(K, g);
            a = 1 + dot(K, c);
            d = a * a + dot(K, {{name}}.adjugate(T) * K);
            free = (a * v + cross(K, T * v)) / d;
            % what the torque adds: (a - K x T)^-1 (M + c K.M)
            m = M + c * dot(K, M);
            once = cross(K, T * m);
            twice = cross(K, T * once);
            rate = free + (m + (a * once + twice) / d) / a;
            braking = T * rate;
            w = g + cross(c, rate) + braking;
            power = dot(rate, braking);
        end

        function dy = rates(y, M)
            % Right-hand side: rates of the state y = [K; quaternion].
            [w, rate] = {{name}}.motion(y(1:3), M);
            v = y(5:7);
            v = v(:);
            dy = [rate; -dot(v, w) / 2; (y(4) * w + cross(v, w)) / 2];
        end

        function K = momentum_of(w)
            % Angular momentum with an angular velocity where no torque acts.
            w = w(:);
            J = {{name}}.inertia();
            K = J * w + {{wheels}}';
            for i = 1:200
                gap = w - {{name}}.motion(K, [0; 0; 0]);
                if norm(gap) <= 4e-16 * norm(w)
                    return
                end
                K = K + J * gap;
            end
            if ~(norm(gap) <= 1e-12 * norm(w))
                error('no angular momentum has this angular velocity: it is beyond the range of the equations');
            end
        end

        function code = status(y, M)
            % Status of a state: 0 the equations hold, 1 digits are lost, 2 they fail, 3 no number.
            spin = norm({{name}}.motion(y(1:3), [0; 0; 0]));
            % the angular acceleration of a torque counts as the square of a spin
            spin = max(spin, sqrt(norm(M) / {{least_moment}}));
            if ~all(isfinite([spin; y(:)]))
                code = 3;
            else
                code = (spin >= {{spin_holds}}) + (spin >= {{spin_fails}});
            end
        end

        function E = energy(K)
            % Energy (J).
            E = {{energy}};
        end

        function g = energy_gradient(K)
            g = zeros(3, 1);
            g(1) = {{gradient_x}};
            g(2) = {{gradient_y}};
            g(3) = {{gradient_z}};
        end

        function c = internal_momenta(K)
            c = zeros(3, 1);
            c(1) = {{c_x}};
            c(2) = {{c_y}};
            c(3) = {{c_z}};
        end

        function T = dissipation(K)
            xx = {{T_xx}};
            yy = {{T_yy}};
            zz = {{T_zz}};
            yz = {{T_yz}};
            zx = {{T_zx}};
            xy = {{T_xy}};
            T = {{name}}.symmetric([xx, yy, zz, yz, zx, xy]);
        end

        function J = inertia()
            % Inertia about the centre of mass (kg m^2, body axes).
            J = {{name}}.symmetric({{inertia}});
        end

        function m = mass()
            % Mass (kg).
            m = {{mass}};
        end

        function A = symmetric(S)
            A = [S(1), S(6), S(5); S(6), S(2), S(4); S(5), S(4), S(3)];
        end

        function A = adjugate(S)
            A = [cross(S(:, 2), S(:, 3)), cross(S(:, 3), S(:, 1)), cross(S(:, 1), S(:, 2))];
        end

        function worst = self_test()
            % Largest relative difference from quasirigid's own numbers.
            tests = {{tests}};
            found = zeros(size(tests, 1), 8);
            for i = 1:size(tests, 1)
                [w, rate, power] = {{name}}.motion(tests(i, 1:3), tests(i, 4:6));
                found(i, :) = [w', rate', power, {{name}}.energy(tests(i, 1:3))];
            end
            apart = abs(found - tests(:, 7:14));
            kept = abs(tests(:, 7:14));
            worst = 0;
            columns = {1:3, 4:6, 7, 8};
            for i = 1:4
                largest = max(max(max(kept(:, columns{i}))), 1e-300);
                worst = max(worst, max(max(apart(:, columns{i}))) / largest);
            end
        end
    end
end
